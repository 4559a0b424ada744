#include "integrator/icosphere.h"

#include <cassert>
#include <cmath>

namespace lumivec {

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

void IcosphereStore::clear() {
  faces_.clear();
  lists_.clear();
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
