#include <algorithm>
#include <cmath>

#include "loader/pov/functions.h"
#include "loader/pov/number_functions.h"

namespace lumivec::pov {
namespace {

constexpr double largest_series = 1e6;  // passes of one sum
constexpr double beyond_division = 1e300;

double component_of(const Number& number, int component) {
  if (component == gray_component)
    return 0.297 * number.n[0] + 0.589 * number.n[1] + 0.114 * number.n[2];
  return number.n[static_cast<std::size_t>(component)];
}

class Evaluation {
 public:
  Evaluation(const Function& function, std::span<const double> arguments, std::uint64_t& nodes_left)
      : function_(function),
        values_(function.nodes.size()),
        arguments_(arguments.begin(), arguments.end()),
        nodes_left_(nodes_left) {}

  std::optional<double> run() {
    const auto count = static_cast<std::uint32_t>(function_.nodes.size());
    run(0, count);
    if (unknown_ || count == 0) return std::nullopt;
    return values_.back();
  }

 private:
  void run(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end && !unknown_; ++i) {
      if (nodes_left_ == 0) {
        unknown_ = true;
        return;
      }
      --nodes_left_;
      values_[i] = value(function_.nodes[i]);
    }
  }

  double operand(const FunctionNode& node, std::size_t i) const {
    return values_[node.operands[i]];
  }

  double value(const FunctionNode& node) {
    switch (node.operation) {
      case Operation::constant:
        return node.value;
      case Operation::parameter:
        return node.index < arguments_.size() ? arguments_[node.index] : 0.0;
      case Operation::add:
        return operand(node, 0) + operand(node, 1);
      case Operation::subtract:
        return operand(node, 0) - operand(node, 1);
      case Operation::multiply:
        return operand(node, 0) * operand(node, 1);
      case Operation::divide:
        return operand(node, 1) == 0.0 ? beyond_division : operand(node, 0) / operand(node, 1);
      case Operation::negate:
        return -operand(node, 0);
      case Operation::invert:
        return operand(node, 0) == 0.0;
      case Operation::less:
        return operand(node, 0) < operand(node, 1);
      case Operation::less_or_equal:
        return operand(node, 0) <= operand(node, 1);
      case Operation::equal:
        return operand(node, 0) == operand(node, 1);
      case Operation::unequal:
        return operand(node, 0) != operand(node, 1);
      case Operation::both:
        return operand(node, 0) != 0.0 && operand(node, 1) != 0.0;
      case Operation::either:
        return operand(node, 0) != 0.0 || operand(node, 1) != 0.0;
      case Operation::choose:
        return operand(node, 0) < 0.0    ? operand(node, 1)
               : operand(node, 0) == 0.0 ? operand(node, 2)
                                         : operand(node, 3);
      case Operation::minimum:
      case Operation::maximum:
        return extreme(node);
      case Operation::built_in:
        return built_in(node);
      case Operation::call:
        return call(node);
      case Operation::sum:
      case Operation::product:
        return series(node);
    }
    return 0.0;
  }

  double extreme(const FunctionNode& node) const {
    double best = operand(node, 0);
    for (std::size_t i = 1; i < node.operands.size(); ++i) {
      best = node.operation == Operation::minimum ? std::min(best, operand(node, i))
                                                  : std::max(best, operand(node, i));
    }
    return best;
  }

  double built_in(const FunctionNode& node) const {
    double x[3] = {};
    for (std::size_t i = 0; i < node.operands.size(); ++i) x[i] = operand(node, i);
    const FloatFunction& built_in = *float_function(node.keyword);
    return built_in.undefined && built_in.undefined(x) ? 0.0 : built_in.value(x);
  }

  double call(const FunctionNode& node) {
    std::vector<double> given;
    for (std::size_t i = 0; i < node.operands.size(); ++i) given.push_back(operand(node, i));
    const auto result = evaluate(*function_.functions[node.index], given, nodes_left_);
    if (result) return component_of(*result, node.component);
    unknown_ = true;
    return 0.0;
  }

  double series(const FunctionNode& node) {
    const double first = operand(node, 0), last = operand(node, 1);
    const std::uint32_t term = node.operands[2], begin = node.operands[3];
    if (arguments_.size() <= node.index) arguments_.resize(node.index + 1);
    double total = node.operation == Operation::sum ? 0.0 : 1.0;
    if (!(last - first < largest_series)) return total;
    for (double i = first; i <= last && !unknown_; i += 1.0) {
      arguments_[node.index] = i;
      run(begin, term + 1);
      total = node.operation == Operation::sum ? total + values_[term] : total * values_[term];
    }
    return total;
  }

  const Function& function_;
  std::vector<double> values_;
  std::vector<double> arguments_;
  std::uint64_t& nodes_left_;
  bool unknown_ = false;
};

}  // namespace

std::optional<Number> evaluate(const Function& function, std::span<const double> arguments,
                               std::uint64_t& nodes_left) {
  switch (function.kind) {
    case FunctionKind::expression:
      if (const auto value = Evaluation(function, arguments, nodes_left).run())
        return Number(*value);
      return std::nullopt;
    case FunctionKind::spline:
      if (arguments.empty()) return std::nullopt;
      return spline_value(*function.spline, arguments[0], function.spline->kind);
    case FunctionKind::transform: {
      if (arguments.size() < 3) return std::nullopt;
      const V3d p = V3d(arguments[0], arguments[1], arguments[2]) * function.transform;
      Number number;
      number.size = 3;
      for (int i = 0; i < 3; ++i) number.n[static_cast<std::size_t>(i)] = p[i];
      return number;
    }
    case FunctionKind::internal:
      return internal_function(function.internal, arguments);
    case FunctionKind::pigment:
    case FunctionKind::pattern:
      break;
  }
  return std::nullopt;
}

}  // namespace lumivec::pov
