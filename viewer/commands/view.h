// `lumivec view`: the window.
#pragma once

#include "viewer/window/window_app.h"

namespace CLI {
class App;
}

namespace lumivec {

struct ViewOptions {
  WindowOptions window;
  SceneSource source;
};

// What the help of the command ends with: the keys.
std::string view_footer();
void add_view_options(CLI::App& app, ViewOptions& options);
// Throws UsageError.
void check_view_options(const CLI::App& app, const ViewOptions& options);
// Returns the exit status. Throws what the loader, the integrator and the window throw.
int run_view(const ViewOptions& options);

}  // namespace lumivec
