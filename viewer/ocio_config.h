// The OpenColorIO configuration in force, and how the renderer's colours enter it.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

#include "viewer/display_error.h"

namespace lumivec {

// file: an OpenColorIO configuration; "builtin": the program's own; empty: what the environment
// variable OCIO names, else the program's own. Throws DisplayError.
OCIO_NAMESPACE::ConstConfigRcPtr load_ocio_config(const std::string& file);

std::vector<std::string> display_names(const OCIO_NAMESPACE::ConstConfigRcPtr& config);
std::vector<std::string> view_names(const OCIO_NAMESPACE::ConstConfigRcPtr& config,
                                    const std::string& display);
std::vector<std::string> look_names(const OCIO_NAMESPACE::ConstConfigRcPtr& config);

// From linear Rec. 709 / D65, in which the renderer works, to a view of a display. Where the
// configuration has no colour space of a known name for it, the way leads through its interchange
// role, and where it has none, its scene_linear role is taken to be linear Rec. 709. look: one of
// the configuration's, in place of those that the view has; empty: the view's. Throws DisplayError.
OCIO_NAMESPACE::ConstProcessorRcPtr display_processor(
    const OCIO_NAMESPACE::ConstConfigRcPtr& config, const std::string& display,
    const std::string& view, const std::string& look);

}  // namespace lumivec
