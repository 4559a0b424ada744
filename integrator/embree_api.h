// All that differs between Embree 3.13 and 4, and the handles' ownership. No other file calls a
// version-specific name.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>

namespace lumivec::embree {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
inline void init(QueryContext& context) {
  rtcInitRayQueryContext(&context);
}

namespace detail {
inline RTCIntersectArguments intersect_arguments(QueryContext& context) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  return arguments;
}
inline RTCOccludedArguments occluded_arguments(QueryContext& context) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  return arguments;
}
}  // namespace detail

inline void intersect1(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments = detail::intersect_arguments(context);
  rtcIntersect1(scene, &ray, &arguments);
}
inline void intersect8(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit8& rays) {
  RTCIntersectArguments arguments = detail::intersect_arguments(context);
  rtcIntersect8(valid, scene, &rays, &arguments);
}
// Of rays that start together and go much the same way.
inline void intersect8_coherent(const int* valid, RTCScene scene, QueryContext& context,
                                RTCRayHit8& rays) {
  RTCIntersectArguments arguments = detail::intersect_arguments(context);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &rays, &arguments);
}
inline void occluded1(RTCScene scene, QueryContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments = detail::occluded_arguments(context);
  rtcOccluded1(scene, &ray, &arguments);
}
inline void occluded8(const int* valid, RTCScene scene, QueryContext& context, RTCRay8& rays) {
  RTCOccludedArguments arguments = detail::occluded_arguments(context);
  rtcOccluded8(valid, scene, &rays, &arguments);
}
#else
using QueryContext = RTCIntersectContext;
inline void init(QueryContext& context) {
  rtcInitIntersectContext(&context);
}
inline void intersect1(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}
inline void intersect8(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit8& rays) {
  rtcIntersect8(valid, scene, &context, &rays);
}
// Of rays that start together and go much the same way.
inline void intersect8_coherent(const int* valid, RTCScene scene, QueryContext& context,
                                RTCRayHit8& rays) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &rays);
}
inline void occluded1(RTCScene scene, QueryContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}
inline void occluded8(const int* valid, RTCScene scene, QueryContext& context, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &context, &rays);
}
#endif

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseScene>;

}  // namespace lumivec::embree
