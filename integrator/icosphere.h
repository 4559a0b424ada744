// Recursive icosahedra that hold records by direction (paper, section 3.2): the last two of the
// cache's five dimensions. A face that is full is replaced by its four children. Records are
// inserted while others look, and look-ups never block.
//
// Many icospheres share one store. One of up to sixteen records is a list of them and nothing else,
// 128 bytes; beyond, it costs 80 bytes for its faces, 8 bytes a record, and as much again or twice
// that for places that are free or were given up by divisions.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "integrator/icosahedron.h"
#include "integrator/packed_direction.h"
#include "integrator/stable_array.h"
#include "loader/scene.h"

namespace lumivec {

// The records of one place, in an IcosphereStore. Neither copied nor moved: others may be looking.
class Icosphere {
 public:
  Icosphere() = default;

 private:
  friend class IcosphereStore;
  static constexpr std::uint32_t empty = ~0u;
  std::atomic<std::uint32_t> link_{empty};
};

class IcosphereStore {
 public:
  // A face with more records than this is divided. Their directions and numbers are two cache
  // lines.
  static constexpr std::uint32_t face_capacity = 16;

  // Adds a record, by a number of the caller's that no other record of the sphere has, below 2^32 −
  // 1. direction: unit; kept with packed_direction_error. Thread-safe.
  void insert(Icosphere& sphere, const V3f& direction, std::uint32_t record);

  // Calls visit(record, cosine) for every record whose direction has that cosine, the cone's least
  // or more, with the cone's own.
  template <typename Visit>
  void for_each_within(const Icosphere& sphere, const DirectionCone& cone,
                       const Visit& visit) const {
    const Start<int> start = {&sphere, 0};
    for_each_within(&start, 1, cone,
                    [&](std::uint32_t record, float cosine, int) { visit(record, cosine); });
  }

  // Of several spheres at once: visit(record, cosine, the sphere's tag). Memory is what takes the
  // time; all spheres are searched in step, so that the processor waits for them at once and not
  // for one after the other.
  template <typename Tag>
  struct Start {
    const Icosphere* sphere;
    Tag tag;
  };
  template <typename Tag, typename Visit>
  void for_each_within(const Start<Tag>* starts, std::size_t count, const DirectionCone& cone,
                       const Visit& visit) const {
    Search<Tag, Visit> search(*this, cone, visit);
    for (std::size_t i = 0; i < count; ++i)
      search.follow(starts[i].sphere->link_, {whole_sphere, 0}, starts[i].tag);
    search.finish();
  }

  std::size_t bytes() const { return faces_.bytes() + lists_.bytes(); }

  // Every icosphere that used the store must be made anew. Not while others use the store.
  void clear();

 private:
  // A link is what a sphere or a face holds: nothing, the index of a list and whether it fills more
  // than one cache line, or the index of the first of its faces, 20 of a sphere and 4 of a face.
  static constexpr std::uint32_t empty = Icosphere::empty;
  static constexpr std::uint32_t divided_bit = 1u << 31;
  static constexpr std::uint32_t longer_bit = 1u << 30;
  static constexpr std::uint32_t line_capacity = face_capacity / 2;
  static bool divided(std::uint32_t link) { return link != empty && (link & divided_bit) != 0; }

  struct Face {
    std::atomic<std::uint32_t> link{empty};
  };

  // Of squared cosines.
  static constexpr float rounding = 1e-6f;

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

  // Calls visit(record, cosine) for the records of a list that are in the cone.
  template <typename Visit>
  void scan(std::uint32_t list, const DirectionCone& cone, const Visit& visit) const {
    const List& l = lists_[list];
    // Eight at a time, whether all are there or not: faster than to know where the list ends.
    constexpr std::uint32_t width = line_capacity;
    const float signed_square = cone.min_cosine * std::abs(cone.min_cosine) - rounding;
    for (std::uint32_t first = 0; first < face_capacity; first += width) {
      std::array<std::uint64_t, width> entries;
      for (std::uint32_t i = 0; i < width; ++i)
        entries[i] = l.entries[first + i].load(std::memory_order_acquire);
      std::array<float, width> product, length2, above;
      for (std::uint32_t i = 0; i < width; ++i) {
        const V3f v = unpack_octahedral(static_cast<std::uint32_t>(entries[i] >> 32));
        product[i] = v.dot(cone.direction);
        length2[i] = v.length2();
        above[i] = product[i] * std::abs(product[i]) - signed_square * length2[i];
      }
      for (std::uint32_t near = not_negative(above); near != 0; near &= near - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(near));
        if (entries[i] == no_entry) return;
        const float cosine = product[i] / std::sqrt(length2[i]);
        if (cosine >= cone.min_cosine) visit(static_cast<std::uint32_t>(entries[i]), cosine);
      }
      if (entries[width - 1] == no_entry) return;
    }
  }

  // Faces and lists wait in queues until what they read has been fetched.
  template <typename Tag, typename Visit>
  class Search {
   public:
    Search(const IcosphereStore& store, const DirectionCone& cone, const Visit& visit)
        : store_(store), cone_(cone), visit_(visit) {}

    void follow(const std::atomic<std::uint32_t>& from, const Place& place, const Tag& tag) {
      const std::uint32_t link = from.load(std::memory_order_acquire);
      if (link == empty) return;
      if (!divided(link)) return add_list(link, tag);
      const std::uint32_t first = link & ~divided_bit;
      if (place.face == whole_sphere) {
        for (std::uint32_t i = 0; i < cone_.root_count; ++i)
          add_face(first + cone_.roots[i], part(place, cone_.roots[i]), tag);
        return;
      }
      std::uint32_t touched =
          by_direction(place) ? store_.geometry_.children_touched(place.face, cone_) : 15;
      for (; touched != 0; touched &= touched - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(touched));
        add_face(first + i, part(place, i), tag);
      }
    }

    void finish() {
      while (oldest_face_ != face_count_) {
        const WaitingFace f = faces_[oldest_face_++ % capacity];
        follow(store_.faces_[f.face].link, f.place, f.tag);
      }
      scan_lists();
    }

   private:
    static constexpr std::uint32_t capacity = 64;
    struct WaitingFace {
      std::uint32_t face;
      Place place;
      Tag tag;
    };
    struct WaitingList {
      std::uint32_t list;
      Tag tag;
    };

    void add_face(std::uint32_t face, const Place& place, const Tag& tag) {
      const auto& link = store_.faces_[face].link;
      if (face_count_ - oldest_face_ == capacity) return follow(link, place, tag);
      __builtin_prefetch(&link);
      faces_[face_count_++ % capacity] = {face, place, tag};
    }
    void add_list(std::uint32_t link, const Tag& tag) {
      const List& l = store_.lists_[link & ~longer_bit];
      __builtin_prefetch(&l.entries[0]);
      if ((link & longer_bit) != 0) __builtin_prefetch(&l.entries[line_capacity]);
      lists_[list_count_++] = {link & ~longer_bit, tag};
      if (list_count_ == capacity) scan_lists();
    }
    void scan_lists() {
      for (std::uint32_t i = 0; i < list_count_; ++i) {
        store_.scan(lists_[i].list, cone_, [&](std::uint32_t record, float cosine) {
          visit_(record, cosine, lists_[i].tag);
        });
      }
      list_count_ = 0;
    }

    const IcosphereStore& store_;
    const DirectionCone& cone_;
    const Visit& visit_;
    std::uint32_t oldest_face_ = 0, face_count_ = 0, list_count_ = 0;
    WaitingFace faces_[capacity];
    WaitingList lists_[capacity];
  };

  bool append(std::atomic<std::uint32_t>& link, std::uint64_t entry);
  std::uint32_t divide(const List& list, const Place& place);

  const Icosahedron& geometry_ = icosahedron();
  StableArray<Face> faces_;
  StableArray<List> lists_;
  // Those who insert take turns, those of one sphere at least.
  static constexpr std::size_t lock_count = 64;
  std::array<std::mutex, lock_count> locks_;
};

}  // namespace lumivec
