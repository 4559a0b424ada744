#include "integrator/albedo_tables.h"

namespace lumivec {

AlbedoTables::AlbedoTables(std::span<const float> /*indices*/) {}

}  // namespace lumivec
