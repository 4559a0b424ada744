#include "viewer/commands/view.h"

namespace lumivec {

int run_view(const ViewOptions& options) {
  WindowOptions window = options.window;
  window.scene = options.source;
  return run_window(window);
}

}  // namespace lumivec
