#include "viewer/version.h"

#include <OpenColorIO/OpenColorIO.h>
#include <OpenImageIO/imageio.h>

namespace lumivec {

std::string version_number() {
  return LUMIVEC_VERSION;
}

std::string software_name() {
  return "lumivec " + version_number();
}

std::string version_text() {
  return software_name() + " (OpenColorIO " + OCIO_NAMESPACE::GetVersion() + ", OpenImageIO " +
         OIIO_VERSION_STRING + ")";
}

}  // namespace lumivec
