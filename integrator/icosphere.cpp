#include "integrator/icosphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace lumivec {

namespace {

// Of a table, for each record of its sphere.
constexpr std::size_t most_table_entries = 2;
// Faces with more records than this, as the mean record sees it, are divided if the table may grow.
constexpr double crowded = 16.0;

}  // namespace

void IcosphereStore::insert(Icosphere& sphere, const V3f& unpacked, std::uint32_t record) {
  assert(std::abs(unpacked.length2() - 1.0f) < 1e-3f);
  assert(record != ~0u);
  // Faces are chosen by the direction as it will be read.
  const std::uint32_t packed = pack_direction(unpacked);
  const V3f direction = unpack_direction(packed);
  const std::uint64_t entry = std::uint64_t{packed} << 32 | record;
  const std::lock_guard lock(
      locks_[reinterpret_cast<std::uintptr_t>(&sphere) / sizeof(Icosphere) % lock_count]);
  std::atomic<std::uint32_t>* slot = &sphere.link_;
  Place place = {whole_sphere, 0};
  while (true) {
    std::uint32_t link = slot->load(std::memory_order_relaxed);
    if (!divided(link)) {
      if (append(*slot, entry)) return;
      link = divide(lists_[link & ~longer_bit], place) | divided_bit;
      slot->store(link, std::memory_order_release);
    }
    const std::uint32_t which = part_of(place, direction, record);
    slot = &faces_[(link & ~divided_bit) + which].link;
    place = part(place, which);
  }
}

std::vector<std::uint32_t> IcosphereStore::pack(StableArray<Icosphere>& spheres,
                                                const std::vector<std::uint32_t>& order,
                                                std::uint32_t count) {
  const auto before = std::move(directions_);
  directions_ = {};
  // The last ones are read together with what is behind them.
  directions_.reserve(std::size_t{count} + width);
  tables_.clear();
  std::vector<std::uint32_t> former;
  former.reserve(count);
  std::vector<Packed> packed(order.size());
  std::vector<Entry> entries;
  std::vector<std::pair<std::uint32_t, Entry>> left;  // with the new indices of their spheres
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Icosphere& sphere = spheres[order[i]];
    entries.clear();
    for (std::uint32_t r = sphere.packed_.begin; r < sphere.packed_.end; ++r)
      entries.push_back({r, before[r], r});
    gather(sphere.link_.load(std::memory_order_relaxed), {whole_sphere, 0}, entries);
    while (entries.size() > most_packed) {
      left.emplace_back(static_cast<std::uint32_t>(i), entries.back());
      entries.pop_back();
    }
    packed[i].begin = static_cast<std::uint32_t>(former.size());
    packed[i].end = packed[i].begin + static_cast<std::uint32_t>(entries.size());
    tabulate(packed[i], entries);
    for (const Entry& entry : entries) {
      directions_.push_back(entry.direction);
      former.push_back(entry.record);
    }
  }
  assert(former.size() + left.size() == count);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    spheres[i].packed_ = packed[i];
    spheres[i].link_.store(empty, std::memory_order_relaxed);
  }
  packed_count_ = static_cast<std::uint32_t>(former.size());
  directions_.resize(former.size() + width);
  tables_.shrink_to_fit();
  faces_.clear();
  lists_.clear();
  for (const auto& [sphere, entry] : left) {
    insert(spheres[sphere], unpack_direction(entry.direction),
           static_cast<std::uint32_t>(former.size()));
    former.push_back(entry.record);
  }
  return former;
}

void IcosphereStore::gather(std::uint32_t link, const Place& place,
                            std::vector<Entry>& entries) const {
  if (link == empty) return;
  if (!divided(link)) {
    for (const auto& stored : lists_[link & ~longer_bit].entries) {
      const std::uint64_t entry = stored.load(std::memory_order_relaxed);
      if (entry == no_entry) return;
      const auto record = static_cast<std::uint32_t>(entry);
      entries.push_back({record, static_cast<std::uint32_t>(entry >> 32), record});
    }
    return;
  }
  const std::uint32_t first = link & ~divided_bit;
  for (std::uint32_t i = 0; i < part_count(place); ++i)
    gather(faces_[first + i].link.load(std::memory_order_relaxed), part(place, i), entries);
}

void IcosphereStore::tabulate(Packed& sphere, std::vector<Entry>& entries) {
  if (entries.size() <= face_capacity) return;
  int deepest = 0;
  while (deepest < deepest_face_level &&
         Icosahedron::face_count(deepest + 1) <= most_table_entries * entries.size()) {
    ++deepest;
  }
  const std::uint32_t first = Icosahedron::first_face(deepest);
  for (Entry& entry : entries) {
    const std::uint32_t face =
        geometry_.face_of(unpack_direction(entry.direction), deepest) - first;
    entry.key = std::uint64_t{face} << 32 | entry.record;
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key < b.key; });

  std::vector<std::uint32_t> counts;
  int level = 0;
  while (true) {
    counts.assign(Icosahedron::face_count(level), 0);
    for (const Entry& entry : entries) ++counts[entry.key >> (32 + 2 * (deepest - level))];
    double squares = 0.0;
    for (const std::uint32_t c : counts) squares += static_cast<double>(c) * c;
    // The mean face of a record.
    if (level == deepest || squares <= crowded * static_cast<double>(entries.size())) break;
    ++level;
  }
  sphere.level = static_cast<std::uint32_t>(level) & 7;
  sphere.table = static_cast<std::uint32_t>(tables_.size()) & ((1u << 29) - 1);
  std::uint32_t begin = 0;
  for (const std::uint32_t c : counts) {
    tables_.push_back(static_cast<std::uint16_t>(begin));
    begin += c;
  }
  tables_.push_back(static_cast<std::uint16_t>(begin));
}

void IcosphereStore::clear() {
  faces_.clear();
  lists_.clear();
  directions_ = {};
  tables_ = {};
  packed_count_ = 0;
}

std::uint32_t IcosphereStore::part_of(const Place& place, const V3f& direction,
                                      std::uint32_t record) const {
  if (place.face == whole_sphere) return geometry_.root_of(direction);
  if (by_direction(place)) return geometry_.child_of(place.face, direction);
  assert(place.bits < 32);  // or two records have one number
  return (record >> place.bits) & 3;
}

// To the list of a link, a new one if there is none. False: it is full.
bool IcosphereStore::append(std::atomic<std::uint32_t>& link, std::uint64_t entry) {
  const std::uint32_t old = link.load(std::memory_order_relaxed);
  const std::uint32_t index = old == empty ? lists_.grow() : old & ~longer_bit;
  List& list = lists_[index];
  for (std::uint32_t i = 0; i < face_capacity; ++i) {
    if (list.entries[i].load(std::memory_order_relaxed) != no_entry) continue;
    list.entries[i].store(entry, std::memory_order_release);
    const std::uint32_t now = i < line_capacity ? index : index | longer_bit;
    if (now != old) link.store(now, std::memory_order_release);
    return true;
  }
  return false;
}

// Faces with the records of a list, which stays as it is: others may be reading it.
std::uint32_t IcosphereStore::divide(const List& list, const Place& place) {
  const std::uint32_t first = faces_.grow(part_count(place));
  for (const auto& stored : list.entries) {
    const std::uint64_t entry = stored.load(std::memory_order_relaxed);
    const V3f direction = unpack_direction(static_cast<std::uint32_t>(entry >> 32));
    const auto record = static_cast<std::uint32_t>(entry);
    append(faces_[first + part_of(place, direction, record)].link, entry);
  }
  return first;
}

}  // namespace lumivec
