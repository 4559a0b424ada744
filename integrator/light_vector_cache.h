// The cache in five dimensions (paper, section 3.2; method, section 3): records by position, in a
// k-d tree, and at each position by view direction, in a recursive icosahedron. Records are
// inserted while others look, and look-ups never block.
//
// A look-up that meets seven positions takes 0.8 µs where all is in the processor's cache, and
// three with 100,000 positions of 100 directions, measured beside other work: it waits for memory.
// An insertion takes 0.3 to 1.1 µs. A record takes its own size and 25 to 30 bytes where there are
// many a position, a lone one about 250.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "integrator/cone_faces.h"
#include "integrator/icosphere.h"
#include "integrator/point_tree.h"
#include "integrator/prefetch.h"
#include "integrator/stable_array.h"
#include "integrator/waiting_line.h"
#include "loader/scene.h"

namespace lumivec {

// Record: any default-constructible and assignable type.
template <typename Record>
class LightVectorCache {
 public:
  // A cache that takes up `max_bytes` or more, or would if it went on, stores no more records.
  explicit LightVectorCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  // Stores a record of a position and a view direction (unit) that can be used as far as `reach`
  // (≥ 0, scene units). It shares a position that is no farther than `tolerance` (scene units) and
  // reaches as far, if there is one. False: the cache is full. Thread-safe.
  bool insert(const V3f& position, float reach, float tolerance, const V3f& direction,
              const Record& record) {
    if (full()) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    const std::uint32_t index = records_.grow();
    records_[index] = record;
    std::uint32_t place = none;
    float nearest = tolerance * tolerance;
    tree_.for_each_within(position, tolerance, [&](std::uint32_t i, float distance2) {
      if (distance2 > nearest || tree_.reach(i) < reach) return;
      place = i;
      nearest = distance2;
    });
    if (place != none) {
      spheres_.insert(places_[place], direction, index);
      return true;
    }
    tree_.insert(position, reach, [&](std::uint32_t added) {
      while (places_.size() <= added) places_.grow();
      spheres_.insert(places_[added], direction, index);
    });
    return true;
  }

  // Calls visit(record, squared distance, cosine) for every record whose position's reach times
  // scale covers p and whose direction has min_cosine or more with the given one (unit). Distances
  // are to the position that the record shares.
  template <typename Visit>
  void look_up(const V3f& p, const V3f& direction, float scale, float min_cosine,
               const Visit& visit) const {
    const Query query = {p, direction, scale, min_cosine};
    look_up_packet<1>(&query, 1, [&](std::size_t, const Record& r, float distance2, float cosine) {
      visit(r, distance2, cosine);
    });
  }

  // The same for several places and directions at once: visit(query, record, squared distance,
  // cosine), in the same order for each of them. They are looked up in step, so that the processor
  // waits for all their memory at once; eight or more go together best.
  struct Query {
    V3f position{0.0f}, direction{0.0f};
    float scale = 1.0f, min_cosine = 1.0f;
  };
  template <typename Visit>
  void look_up(const Query* queries, std::size_t count, const Visit& visit) const {
    for (std::size_t first = 0; first < count; first += packet) {
      look_up_packet<packet>(queries + first, std::min(packet, count - first),
                             [&](std::size_t query, const Record& r, float distance2,
                                 float cosine) { visit(first + query, r, distance2, cosine); });
    }
  }

  // Packs the tree of positions and, if a good part of them is new, the records of each position:
  // look-ups are then several times as fast. Positions and records that are near each other move
  // next to each other. Takes 8 bytes a record for as long as it lasts. Not while others use the
  // cache.
  void balance() {
    const auto reach = [this](std::uint32_t i) { return tree_.reach(i); };
    const std::uint32_t count = records_.size();
    if (static_cast<double>(count) <= static_cast<double>(spheres_.packed_count()) * repacked) {
      tree_.rebuild(reach);
      return;
    }
    const std::vector<std::uint32_t> order = tree_.renumber(reach);
    permute_records(spheres_.pack(places_, order, count));
  }

  // Gives all memory back. Not while others use the cache.
  void clear() {
    tree_.clear();
    places_.clear();
    spheres_.clear();
    records_.clear();
    refused_.store(0, std::memory_order_relaxed);
  }

  std::uint32_t position_count() const { return tree_.size(); }
  std::uint32_t record_count() const { return records_.size(); }
  // Records that did not find room.
  std::uint64_t refused_count() const { return refused_.load(std::memory_order_relaxed); }
  std::size_t bytes() const {
    return tree_.bytes() + places_.bytes() + spheres_.bytes() + records_.bytes();
  }
  bool full() const { return bytes() * growth > static_cast<double>(max_bytes_); }

 private:
  static constexpr std::uint32_t none = ~0u;
  // What memory may become by the next insertion: arrays grow by a quarter.
  static constexpr double growth = 1.25;

  // Records are packed again when there are so many times as many as were packed: what that costs
  // for each record that is ever inserted stays the same.
  static constexpr double repacked = 1.25;

  // Queries that are looked up in step.
  static constexpr std::size_t packet = 16;

  using Origin = IcosphereStore::Origin;
  struct FoundRecord {
    const Record* record;
    float cosine;
    Origin origin;
  };
  static constexpr std::uint32_t waiting_records = 32;

  // Of at most `most` queries.
  template <std::size_t most, typename Visit>
  void look_up_packet(const Query* queries, std::size_t count, const Visit& visit) const {
    std::array<ConeFaces, most> cones;
    std::array<PointTree::Reaching, most> places;
    for (std::size_t i = 0; i < count; ++i) {
      places[i] = {queries[i].position, queries[i].scale};
      cones[i] = ConeFaces(icosahedron().cone(queries[i].direction, queries[i].min_cosine));
    }
    WaitingLine<FoundRecord, waiting_records> records;
    const auto visit_record = [&](const FoundRecord& r) {
      visit(r.origin.query, *r.record, r.origin.distance2, r.cosine);
    };
    const auto found = [&](std::uint32_t index, float cosine, const Origin& origin) {
      const Record* record = &records_[index];
      prefetch(*record);
      records.add({record, cosine, origin}, visit_record);
    };
    bool any_new = true;
    if (spheres_.packed_count() > 0) {
      IcosphereStore::PackedSearch<decltype(found)> search(spheres_, cones.data(), found);
      tree_.for_each_reaching<most>(
          places.data(), count, [&](std::size_t query, std::uint32_t place, float distance2) {
            search.add(places_[place], {static_cast<std::uint32_t>(query), distance2});
          });
      search.finish();
      any_new = search.saw_new();
    }
    // New records come after all others, so that their order does not depend on the packet.
    if (any_new) look_up_new<most>(places, cones, count, found);
    records.finish(visit_record);
  }

  template <std::size_t most, typename Found>
  void look_up_new(const std::array<PointTree::Reaching, most>& places,
                   const std::array<ConeFaces, most>& cones, std::size_t count,
                   const Found& found) const {
    constexpr std::size_t at_once = 64;
    std::array<IcosphereStore::Start, at_once> starts;
    std::size_t waiting = 0;
    const auto search = [&] {
      spheres_.for_each_new_within(starts.data(), waiting, found);
      waiting = 0;
    };
    tree_.for_each_reaching<most>(
        places.data(), count, [&](std::size_t query, std::uint32_t place, float distance2) {
          const Icosphere* sphere = &places_[place];
          prefetch(*sphere);
          starts[waiting++] = {
              sphere, &cones[query].cone(), {static_cast<std::uint32_t>(query), distance2}};
          if (waiting == at_once) search();
        });
    search();
  }

  // former: the former indices, by the new ones; used up.
  void permute_records(std::vector<std::uint32_t> former) {
    for (std::uint32_t i = 0; i < former.size(); ++i) {
      if (former[i] == i) continue;
      // Once round the cycle.
      const Record first = records_[i];
      std::uint32_t to = i;
      while (former[to] != i) {
        const std::uint32_t from = former[to];
        records_[to] = records_[from];
        former[to] = to;
        to = from;
      }
      records_[to] = first;
      former[to] = to;
    }
  }

  std::size_t max_bytes_;
  PointTree tree_;
  StableArray<Icosphere> places_;  // by index in the tree
  IcosphereStore spheres_;
  StableArray<Record> records_;
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace lumivec
