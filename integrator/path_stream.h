// Paths of one tile or one gathering, traced side by side (path_tracer.h). What happens is filed by
// kind: path_stream.cpp starts paths, traces their rays and collects what they bring;
// path_vertex.cpp shades hits and scatters; path_lights.cpp samples lights and adds what rays find;
// path_caches.cpp takes light from caches and photons.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "integrator/path_lane.h"
#include "integrator/path_tracer.h"
#include "integrator/ray_packet.h"

namespace lumivec {

class PathStream {
 public:
  PathStream(const PathTracer& tracer, const Tile& tile, std::uint32_t first_sample,
             std::uint32_t sample_count, std::vector<PixelSums>& sums, RenderStatistics& statistics,
             const CacheUse& cache);

  // ranges: none empty.
  PathStream(const PathTracer& tracer, const Tile& tile, const std::vector<SampleRange>& ranges,
             std::vector<PixelSums>& sums, RenderStatistics& statistics, const CacheUse& cache);

  // For paths that gather light.
  PathStream(const PathTracer& tracer, const std::vector<GatherRay>& rays, const MediumStack& media,
             std::uint32_t seed, std::vector<GatherResult>& results, RenderStatistics& statistics,
             const CacheUse& cache, Term term);

  void run();

 private:
  // Paths take turns: all are traced, then all shaded, so that each piece of code stays in the
  // instruction cache for a while and packets are full. On the Cornell box 4 to 12 packets take
  // some 5% less time than one.
  static constexpr int lane_count = 8 * packet_size;
  // Light samples of a vertex that the eye sees and whose indirect light is cached. On the Cornell
  // box four cost a third more than one.
  static constexpr std::uint32_t stop_light_samples = 4;
  // There, besides, so many directions by the cosine toward the environment, whose even parts light
  // sampling finds badly beside a sun: no path goes on by the diffuse lobe.
  static constexpr std::uint32_t stop_sky_samples = 2;

  using Lane = PathLane;
  using Fork = PathFork;
  using Stop = PathStop;

  static std::uint64_t count(const std::vector<SampleRange>& ranges);

  // The random numbers that the lanes will need at their next vertices, if nothing changes there.
  void draw();

  std::size_t number_of(const Lane& lane) const { return static_cast<std::size_t>(&lane - lanes_); }

  // Four numbers for light sampling.
  std::array<float, 4> random_for_lights(const Lane& lane) const;

  // A direction by the BSDF; u_survival: a number for the roulette.
  bool sample_bsdf(const Lane& lane, const Bsdf& bsdf, BsdfSample& sample, float& u_survival) const;

  // Starts paths in idle lanes; false when none are left and none run.
  bool fill();

  void start(Lane& lane, std::uint64_t path);

  // A path whose first event, on a broad lobe, is behind it.
  void start_gathering(Lane& lane, std::uint64_t path);

  void deliver(Lane& lane);

  // Lanes of one packet: their numbers, and how many they are.
  struct Packet {
    std::array<int, packet_size> lanes;
    int size = 0;
  };

  // Puts the lanes for which wanted(lane) holds into packets, and hands these to trace_packet.
  template <typename Wanted, typename TracePacket>
  void in_packets(Wanted wanted, TracePacket trace_packet) {
    Packet packet;
    for (int i = 0; i < lane_count; ++i) {
      if (!wanted(lanes_[i])) continue;
      packet.lanes[static_cast<std::size_t>(packet.size++)] = i;
      if (packet.size < packet_size) continue;
      trace_packet(packet);
      packet.size = 0;
    }
    if (packet.size > 0) trace_packet(packet);
  }

  TraceQuery query_of(const Packet& packet);

  void trace();

  void trace(const Packet& packet);

  void trace_shadows();

  void trace_shadows(const Packet& packet);

  // The other light samples of paths that end where all but direct light is cached.
  void trace_further_shadows();

  // Whether the diffuse lobe has all of its direct light.
  bool only_even_light(const Lane& lane) const;

  // What the diffuse lobe makes of the environment, by a direction that the lobe would scatter to.
  void sample_sky(Lane& lane, const Stop& stop, std::uint32_t number);

  // A new seed for every ray, so that passing a partly opaque surface once says nothing of the next
  // time.
  void seed(const Packet& packet);

  void shade(int i);

  // light_samples: that were taken here.
  void go_on(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
             const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples);

  // Size of a pixel, or of what a gathering path stands for, where the path has come to.
  float footprint(const Lane& lane) const;

  // Adds what photons bring to the non-specular lobes.
  void add_photons(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf);

  // Of the lobes that are there, those whose indirect light caches hold.
  std::uint32_t cached_kinds(const Bsdf& bsdf, const SurfaceParameters& parameters) const;

  // Adds those lobes' indirect light, where the cache has it; otherwise asks for it.
  bool use_cache(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
                 const Bsdf& bsdf);

  // What is not found is asked for, where that is wanted.
  bool look_up(const IrradianceCache& cache, const Lane& lane, const CachePoint& at,
               CachedLight& light);

  bool use_paper_cache(Lane& lane, const PaperPoint& point, const Bsdf& bsdf);

  // Direct and caustic light of the lobes of those kinds, whose indirect light is cached, and all
  // light of the others.
  void shade_beside_cache(Lane& lane, const SurfacePoint& point,
                          const SurfaceParameters& parameters, const Bsdf& bsdf,
                          std::uint32_t kinds, const V3f& receiver, bool may_sample_lights);

  std::optional<Stop>& stop_of(const Lane& lane) { return stops_[number_of(lane)]; }

  std::optional<Fork>& fork_of(const Lane& lane) { return forks_[number_of(lane)]; }

  // Leaves out of the shadow ray's light what the diffuse lobe makes of the environment's even
  // part. diffuse: what the lobe makes of all of that radiance.
  void take_even(Lane& lane, const Color& diffuse, const Color& radiance) const;

  bool any_shadow_light(const Lane& lane) const;

  // What lobes that are not cached bring is most of the noise where other light is; delta lobes
  // have one way to go.
  void split_beside_cache(Lane& lane, const Bsdf& traced) const;

  // Where there are delta lobes alone, as on glass, each of them is followed: a faint one that is
  // drawn now and then would be as bright then as it is rare.
  void split_between_mirrors(Lane& lane, Bsdf& bsdf) const;

  // Keeps the first vertex, for as many continuations as the path has splits.
  void fork(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
            const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples);

  // Sends the path off from its first vertex once more, or forgets the vertex after the last time.
  void next_continuation(Lane& lane);

  void add_environment(Lane& lane);

  void add_even_environment(Lane& lane);

  void add_emission(Lane& lane, const SurfacePoint& point, const Color& emission);

  // Absorption along the ray, in the volume that it runs through.
  void absorb(Lane& lane, const SurfacePoint& point, float distance);

  void note_first_hit(Lane& lane, const SurfacePoint& point, const Color& albedo,
                      const V3f& normal);

  // scattered: what paths go on by, of bsdf. alone_kinds: none will go on by lobes of those kinds
  // to where a light could be found.
  void sample_light(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf, const Bsdf& scattered,
                    const V3f& receiver, std::uint32_t alone_kinds);

  // What the lobes of any surface make of a light sample.
  void add_scattered(Lane& lane, const Bsdf& bsdf, const Bsdf& scattered, const LightSample& light,
                     const Color& arriving, float trials, float sky_trials,
                     std::uint32_t alone_kinds) const;

  void scatter(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
               const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples,
               std::uint32_t cached_kinds = 0);

  void deposit(Lane& lane);

  const PathTracer& t_;
  const Tile tile_ = {};
  const std::uint32_t first_sample_ = 0;
  const std::uint32_t pixel_count_ = 0;
  const std::uint64_t path_count_;
  std::uint64_t next_path_ = 0;
  std::uint32_t rounds_ = 0;
  const CacheUse cache_ = {};
  const std::uint32_t terms_;
  std::vector<PixelSums>* sums_ = nullptr;
  const std::vector<SampleRange>* ranges_ = nullptr;
  std::size_t range_ = 0;
  std::uint32_t within_range_ = 0;
  const std::vector<GatherRay>* rays_to_gather_ = nullptr;
  MediumStack gather_media_;
  std::uint32_t gather_seed_ = 0;
  std::vector<GatherResult>* results_ = nullptr;
  const Term gathered_ = Term::indirect;
  RenderStatistics& statistics_;

  DrawnNumbers drawn_[lane_count / 8];
  // One packet at a time.
  RTCRayHit8 rays_;
  RTCRay8 shadow_rays_;
  std::uint32_t seeds_[packet_size] = {};
  Color transmittance_[packet_size];
  std::uint8_t passed_thin_[packet_size] = {};
  RayHit hits_[lane_count];
  Lane lanes_[lane_count];
  // Apart from the lanes: few of their bytes are needed at a time.
  std::optional<Fork> forks_[lane_count];
  std::optional<Stop> stops_[lane_count];
};

}  // namespace lumivec
