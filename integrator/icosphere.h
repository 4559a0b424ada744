// Recursive icosahedra that hold records by direction (paper, section 3.2): the last two of the
// cache's five dimensions. Records are inserted while others look, and look-ups never block.
//
// Many icospheres share one store. Records that are new are in lists, one for a face; a face that
// is full is replaced by its four children. A sphere of up to sixteen of them is a list and nothing
// else, 128 bytes; beyond, it costs 80 bytes for its faces, 8 bytes a record, and as much again or
// twice that for places that are free or were given up by divisions.
//
// pack() sorts all records by sphere and face: 4 bytes a record for its direction, and up to 4 for
// a table of where the faces of a level begin. A look-up then reads a piece of the table and the
// directions of the faces that its cone touches, and what it finds is close together.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "integrator/cone_faces.h"
#include "integrator/icosahedron.h"
#include "integrator/lanes.h"
#include "integrator/large_pages.h"
#include "integrator/packed_direction.h"
#include "integrator/prefetch.h"
#include "integrator/stable_array.h"
#include "integrator/waiting_line.h"
#include "loader/scene.h"

namespace lumivec {

// The records of one place, in an IcosphereStore. Neither copied nor moved: others may be looking.
class Icosphere {
 public:
  Icosphere() = default;

 private:
  friend class IcosphereStore;
  static constexpr std::uint32_t empty = ~0u;
  std::atomic<std::uint32_t> link_{empty};  // to new records
  // Packed ones, and a table for the faces of a level if they are not so few that all are looked
  // at.
  struct Packed {
    static constexpr std::uint32_t few = 7;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t table : 29 = 0, level : 3 = few;
  };
  static_assert(deepest_face_level < static_cast<int>(Packed::few));
  Packed packed_;
};

class IcosphereStore {
  // Directions are compared eight at a time, whether all are there or not.
  static constexpr std::uint32_t width = 8;
  // Of squared cosines.
  static constexpr float rounding = 1e-6f;

  // Records whose directions are in a cone or, by rounding, next to it, until they are so many that
  // it takes no longer to look at all of them than to wait for the first.
  class Found {
   public:
    static constexpr std::size_t enough = 16, capacity = enough + width;
    std::size_t count = 0;

    bool full() const { return count >= enough; }
    // Of eight directions and their records those of the mask that are in the cone. Not if it is
    // full.
    void add(const std::uint32_t* directions, const std::uint32_t* records, std::uint32_t mask,
             const DirectionCone& cone) {
      const float signed_square = cone.min_cosine * std::abs(cone.min_cosine) - rounding;
      std::array<float, width> dot, square, above;
      for (std::uint32_t i = 0; i < width; ++i) {
        const V3f v = unpack_octahedral(directions[i]);
        dot[i] = v.dot(cone.direction);
        square[i] = v.length2();
        above[i] = dot[i] * std::abs(dot[i]) - signed_square * square[i];
      }
      const Chosen chosen(not_negative(above) & mask);
      chosen.store(records, record_.data() + count);
      chosen.store(dot.data(), dot_.data() + count);
      chosen.store(square.data(), square_.data() + count);
      count += chosen.count();
    }
    // Calls visit(i, record, cosine) for all, and forgets them.
    template <typename Visit>
    void for_each(const Visit& visit) {
      for (std::size_t i = 0; i < count; ++i) visit(i, record_[i], dot_[i] / std::sqrt(square_[i]));
      count = 0;
    }

   private:
    std::array<std::uint32_t, capacity> record_;
    std::array<float, capacity> dot_, square_;
  };

 public:
  // A face with more new records than this is divided. Their directions and numbers are two cache
  // lines.
  static constexpr std::uint32_t face_capacity = 16;

  // Adds a record, by a number of the caller's that no other record of the store has, below 2^32 −
  // 1. direction: unit; kept with packed_direction_error. Thread-safe.
  void insert(Icosphere& sphere, const V3f& direction, std::uint32_t record);

  // Calls visit(record, cosine) for every record whose direction has that cosine, the cone's least
  // or more, with the cone's own.
  template <typename Visit>
  void for_each_within(const Icosphere& sphere, const DirectionCone& cone,
                       const Visit& visit) const {
    const auto found = [&](std::uint32_t record, float cosine, const Origin&) {
      visit(record, cosine);
    };
    ConeFaces faces(cone);
    PackedSearch<decltype(found)> packed(*this, &faces, found);
    packed.add(sphere, {});
    packed.finish();
    const Start start = {&sphere, &cone, {}};
    for_each_new_within(&start, 1, found);
  }

  // What the caller looks a sphere up for; the search does not care.
  struct Origin {
    std::uint32_t query = 0;
    float distance2 = 0.0f;
  };

  // The packed records of many spheres: visit(record, cosine, the sphere's origin), one sphere
  // after the other. Memory is what takes the time: each step waits in line until what it reads has
  // been fetched, while the steps before it go on with what is next.
  template <typename Visit>
  class PackedSearch {
   public:
    // cones: of all queries, by their numbers; they stay for as long as the search.
    PackedSearch(const IcosphereStore& store, ConeFaces* cones, const Visit& visit)
        : store_(store), cones_(cones), visit_(visit) {}

    void add(const Icosphere& sphere, const Origin& origin) {
      prefetch(sphere);
      spheres_.add({&sphere, origin}, [this](const SphereStep& s) { look_at(s); });
    }
    void finish() {
      spheres_.finish([this](const SphereStep& s) { look_at(s); });
      tables_.finish([this](const TableStep& t) { look_at(t); });
      directions_.finish([this](const DirectionsStep& d) { look_at(d); });
      visit_found();
    }
    // Whether a sphere had new records beside its packed ones.
    bool saw_new() const { return saw_new_; }

   private:
    // Long enough for memory to come; from 8 to 32 it makes no difference that can be measured.
    static constexpr std::uint32_t in_line = 8;

    struct SphereStep {
      const Icosphere* sphere;
      Origin origin;
    };
    // Entries `begin` and `end` of a table, of directions from `first` on. Few directions need no
    // table and are known already; they wait all the same, so that nothing is overtaken.
    struct TableStep {
      std::uint32_t first, begin, end;
      bool known;
      Origin origin;
    };
    struct DirectionsStep {
      std::uint32_t begin, end;
      Origin origin;
    };

    void look_at(const SphereStep& s) {
      saw_new_ |= s.sphere->link_.load(std::memory_order_acquire) != empty;
      const Packed packed = s.sphere->packed_;
      const auto add_step = [this](const TableStep& step) {
        tables_.add(step, [this](const TableStep& t) { look_at(t); });
      };
      if (packed.level == Packed::few) {
        prefetch_directions(packed.begin, packed.end);
        return add_step({0, packed.begin, packed.end, true, s.origin});
      }
      ConeFaces& cone = cones_[s.origin.query];
      const int level = static_cast<int>(packed.level);
      cone.find(level);
      const std::uint32_t table = packed.table;
      const ConeFaces::Range* const end = cone.end(level);
      for (const ConeFaces::Range* r = cone.begin(level); r != end; ++r) {
        const std::uint32_t begin = table + r->begin, last = table + r->end;
        __builtin_prefetch(&store_.tables_[begin]);
        __builtin_prefetch(&store_.tables_[last]);
        add_step({packed.begin, begin, last, false, s.origin});
      }
    }
    void look_at(const TableStep& t) {
      DirectionsStep step = {t.begin, t.end, t.origin};
      if (!t.known) {
        step.begin = t.first + store_.tables_[t.begin];
        step.end = t.first + store_.tables_[t.end];
        prefetch_directions(step.begin, step.end);
      }
      if (step.begin != step.end)
        directions_.add(step, [this](const DirectionsStep& d) { look_at(d); });
    }
    void prefetch_directions(std::uint32_t begin, std::uint32_t end) const {
      if (begin == end) return;
      // Mostly these two lines are all.
      constexpr std::uint32_t a_line = cache_line / sizeof(std::uint32_t);
      __builtin_prefetch(&store_.directions_[begin]);
      __builtin_prefetch(&store_.directions_[end - 1]);
      for (std::uint32_t i = begin + a_line; i + a_line < end; i += a_line)
        __builtin_prefetch(&store_.directions_[i]);
    }
    void look_at(const DirectionsStep& d) {
      const DirectionCone& cone = cones_[d.origin.query].cone();
      for (std::uint32_t first = d.begin; first < d.end; first += width) {
        std::array<std::uint32_t, width> records;
        for (std::uint32_t i = 0; i < width; ++i) records[i] = first + i;
        const std::uint32_t there = (1u << std::min(d.end - first, width)) - 1;
        std::fill_n(query_.data() + found_.count, width, d.origin.query);
        std::fill_n(distance2_.data() + found_.count, width, d.origin.distance2);
        found_.add(store_.directions_.data() + first, records.data(), there, cone);
        if (found_.full()) visit_found();
      }
    }
    void visit_found() {
      found_.for_each([this](std::size_t i, std::uint32_t record, float cosine) {
        const Origin origin = {query_[i], distance2_[i]};
        if (cosine >= cones_[origin.query].cone().min_cosine) visit_(record, cosine, origin);
      });
    }

    const IcosphereStore& store_;
    ConeFaces* cones_;
    const Visit& visit_;
    bool saw_new_ = false;
    WaitingLine<SphereStep, in_line> spheres_;
    WaitingLine<TableStep, in_line> tables_;
    WaitingLine<DirectionsStep, in_line> directions_;
    Found found_;
    std::array<std::uint32_t, Found::capacity> query_;
    std::array<float, Found::capacity> distance2_;
  };

  // The new records of several spheres, likewise.
  struct Start {
    const Icosphere* sphere;
    const DirectionCone* cone;
    Origin origin;
  };
  template <typename Visit>
  void for_each_new_within(const Start* starts, std::size_t count, const Visit& visit) const {
    Step step(*this);
    const NewSearch<Visit> search{*this, starts, visit};
    for (std::size_t i = 0; i < count; ++i) {
      if (!step.has_room()) search.finish(step);
      step.follow(starts[i].sphere->link_, {whole_sphere, 0}, *starts[i].cone,
                  static_cast<std::uint16_t>(i));
    }
    search.finish(step);
  }

  // Puts all spheres of the store into an order, and sorts all records by sphere and direction and
  // numbers them anew: 0, 1, 2, …. order: the former indices of the spheres, by the new ones.
  // count: of all records. The former numbers of the records, by the new ones. Not while others use
  // the store.
  std::vector<std::uint32_t> pack(StableArray<Icosphere>& spheres,
                                  const std::vector<std::uint32_t>& order, std::uint32_t count);
  // Records that are packed; the others are new.
  std::uint32_t packed_count() const { return packed_count_; }

  std::size_t bytes() const {
    return faces_.bytes() + lists_.bytes() + directions_.size() * sizeof(directions_[0]) +
           tables_.size() * sizeof(tables_[0]);
  }

  // Every icosphere that used the store must be made anew. Not while others use the store.
  void clear();

 private:
  // A link is what a sphere or a face holds: nothing, the index of a list and whether it fills more
  // than one cache line, or the index of the first of its faces, 20 of a sphere and 4 of a face.
  using Packed = Icosphere::Packed;
  static constexpr std::uint32_t empty = Icosphere::empty;
  static constexpr std::uint32_t divided_bit = 1u << 31;
  static constexpr std::uint32_t longer_bit = 1u << 30;
  static constexpr std::uint32_t line_capacity = face_capacity / 2;
  static bool divided(std::uint32_t link) { return link != empty && (link & divided_bit) != 0; }

  struct Face {
    std::atomic<std::uint32_t> link{empty};
  };

  // Filled from the front. An entry is a direction, in the upper half, and a record, and appears at
  // once.
  static constexpr std::uint64_t no_entry = ~std::uint64_t{0};
  struct alignas(64) List {
    std::atomic<std::uint64_t> entries[face_capacity];
    List() {
      for (auto& entry : entries) entry.store(no_entry, std::memory_order_relaxed);
    }
  };

  // Where a link is: the sphere's own, that of a face, or, below the deepest faces, where records
  // are told apart by bits of their numbers, the bits used so far.
  struct Place {
    std::uint32_t face;
    std::uint32_t bits;
  };
  static constexpr std::uint32_t whole_sphere = ~0u;

  static bool by_direction(const Place& place) { return place.face < divided_faces; }
  static std::uint32_t part_count(const Place& place) {
    return place.face == whole_sphere ? icosahedron_faces : 4;
  }
  static Place part(const Place& place, std::uint32_t which) {
    if (place.face == whole_sphere) return {which, 0};
    if (by_direction(place)) return {Icosahedron::child(place.face, which), 0};
    return {place.face, place.bits + 2};
  }
  std::uint32_t part_of(const Place& place, const V3f& direction, std::uint32_t record) const;

  // What a search for new records has come to, whose memory has been asked for.
  enum class Kind : std::uint16_t {
    face,  // `index` of faces_
    list,  // `index` of lists_
  };
  struct Waiting {
    std::uint32_t index;
    Place place;
    std::uint16_t start;
    Kind kind;
  };

  // The next step of all that waits, in its order. Lists, where a search ends, wait for faces that
  // have farther to go: records come in the same order whatever else is searched.
  class Step {
   public:
    explicit Step(const IcosphereStore& store) : store_(store) {}

    bool has_room() const { return count_ + icosahedron_faces <= capacity; }
    // Some go on.
    bool goes_on() const { return goes_on_; }
    const Waiting* begin() const { return items_; }
    const Waiting* end() const { return items_ + count_; }
    void clear() {
      count_ = 0;
      goes_on_ = false;
    }

    // Adds what a link leads to.
    void follow(const std::atomic<std::uint32_t>& from, const Place& place,
                const DirectionCone& cone, std::uint16_t start) {
      const std::uint32_t link = from.load(std::memory_order_acquire);
      if (link == empty) return;
      if (!divided(link)) {
        const List& l = store_.lists_[link & ~longer_bit];
        __builtin_prefetch(&l.entries[0]);
        if ((link & longer_bit) != 0) __builtin_prefetch(&l.entries[line_capacity]);
        items_[count_++] = {link & ~longer_bit, place, start, Kind::list};
        return;
      }
      const std::uint32_t first = link & ~divided_bit;
      if (place.face == whole_sphere) {
        for (std::uint32_t i = 0; i < cone.root_count; ++i)
          add_face(first + cone.roots[i], part(place, cone.roots[i]), start);
        return;
      }
      std::uint32_t touched =
          by_direction(place) ? store_.geometry_.children_touched(place.face, cone) : 15;
      for (; touched != 0; touched &= touched - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(touched));
        add_face(first + i, part(place, i), start);
      }
    }
    void advance(const Waiting& w, const DirectionCone& cone) {
      if (w.kind == Kind::list) {
        items_[count_++] = w;
      } else {
        follow(store_.faces_[w.index].link, w.place, cone, w.start);
      }
    }

   private:
    static constexpr std::size_t capacity = 128;

    void add_face(std::uint32_t face, const Place& place, std::uint16_t start) {
      __builtin_prefetch(&store_.faces_[face].link);
      items_[count_++] = {face, place, start, Kind::face};
      goes_on_ = true;
    }

    const IcosphereStore& store_;
    std::size_t count_ = 0;
    bool goes_on_ = false;
    Waiting items_[capacity];
  };

  template <typename Visit>
  struct NewSearch {
    const IcosphereStore& store;
    const Start* starts;
    const Visit& visit;

    // Goes on with what waits until it is found, and leaves nothing.
    void finish(Step& step) const {
      if (step.goes_on()) {
        Step next(store);
        for (const Waiting& w : step) {
          if (!next.has_room()) finish(next);
          next.advance(w, *starts[w.start].cone);
        }
        finish(next);
      } else {
        for (const Waiting& w : step) scan(store.lists_[w.index], starts[w.start]);
      }
      step.clear();
    }
    void scan(const List& list, const Start& start) const {
      for (std::uint32_t first = 0; first < face_capacity; first += width) {
        std::array<std::uint64_t, width> entries;
        std::array<std::uint32_t, width> directions, records;
        for (std::uint32_t i = 0; i < width; ++i)
          entries[i] = list.entries[first + i].load(std::memory_order_acquire);
        std::uint32_t there = 0;
        for (std::uint32_t i = 0; i < width; ++i) {
          directions[i] = static_cast<std::uint32_t>(entries[i] >> 32);
          records[i] = static_cast<std::uint32_t>(entries[i]);
          there |= (entries[i] != no_entry ? 1u : 0u) << i;
        }
        Found found;
        found.add(directions.data(), records.data(), there, *start.cone);
        found.for_each([&](std::size_t, std::uint32_t record, float cosine) {
          if (cosine >= start.cone->min_cosine) visit(record, cosine, start.origin);
        });
        if (entries[width - 1] == no_entry) return;
      }
    }
  };

  // A record that is about to be packed.
  struct Entry {
    std::uint64_t key;  // what it is sorted by
    std::uint32_t direction, record;
  };
  // Adds the new entries that a link leads to.
  void gather(std::uint32_t link, const Place& place, std::vector<Entry>& entries) const;
  // Sorts a sphere's entries and adds its table.
  void tabulate(Packed& sphere, std::vector<Entry>& entries);
  // What a table can count. Other records of a sphere stay in lists.
  static constexpr std::size_t most_packed = 0xffff;

  bool append(std::atomic<std::uint32_t>& link, std::uint64_t entry);
  std::uint32_t divide(const List& list, const Place& place);

  const Icosahedron& geometry_ = icosahedron();
  StableArray<Face> faces_;
  StableArray<List> lists_;
  // Packed records, and where in them the faces of a level begin, for the spheres that have many.
  std::vector<std::uint32_t, LargePageAllocator<std::uint32_t>> directions_;
  std::vector<std::uint16_t, LargePageAllocator<std::uint16_t>> tables_;
  std::uint32_t packed_count_ = 0;
  // Those who insert take turns, those of one sphere at least.
  static constexpr std::size_t lock_count = 64;
  std::array<std::mutex, lock_count> locks_;
};

}  // namespace lumivec
