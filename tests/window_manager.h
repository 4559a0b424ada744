// The least of a window manager: programs under Xvfb can be minimised and restored only where there
// is one. And what a desktop says of its display. Both last as long as the object.
#pragma once

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

class WindowManager {
 public:
  explicit WindowManager(const std::string& display) : display_(XOpenDisplay(display.c_str())) {
    if (!display_) throw std::runtime_error("the display does not open");
    XSelectInput(display_, DefaultRootWindow(display_),
                 SubstructureRedirectMask | SubstructureNotifyMask);
    XSync(display_, False);
    thread_ = std::thread([this] { run(); });
  }
  ~WindowManager() {
    stop_ = true;
    thread_.join();
    XCloseDisplay(display_);
  }
  WindowManager(const WindowManager&) = delete;
  WindowManager& operator=(const WindowManager&) = delete;

 private:
  void set_state(::Window window, long state) {
    const Atom name = XInternAtom(display_, "WM_STATE", False);
    const std::array<long, 2> value = {state, None};
    XChangeProperty(display_, window, name, name, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(value.data()), 2);
  }

  void handle(XEvent& event) {
    if (event.type == MapRequest) {
      set_state(event.xmaprequest.window, NormalState);
      XMapWindow(display_, event.xmaprequest.window);
    } else if (event.type == ConfigureRequest) {
      const XConfigureRequestEvent& wanted = event.xconfigurerequest;
      XWindowChanges changes = {
          wanted.x, wanted.y, wanted.width, wanted.height, wanted.border_width, None, Above};
      XConfigureWindow(display_, wanted.window,
                       static_cast<unsigned>(wanted.value_mask) & (CWX | CWY | CWWidth | CWHeight),
                       &changes);
    } else if (event.type == ClientMessage &&
               event.xclient.message_type == XInternAtom(display_, "WM_CHANGE_STATE", False)) {
      set_state(event.xclient.window, IconicState);
      XUnmapWindow(display_, event.xclient.window);
    }
  }

  void run() {
    while (!stop_) {
      while (XPending(display_) > 0) {
        XEvent event;
        XNextEvent(display_, &event);
        handle(event);
      }
      XFlush(display_);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  Display* display_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Says that letters are to be drawn for so many dots an inch; 96 is usual.
class DisplayDensity {
 public:
  DisplayDensity(const std::string& display, int dots) : display_(XOpenDisplay(display.c_str())) {
    if (!display_) throw std::runtime_error("the display does not open");
    const std::string text = "Xft.dpi:\t" + std::to_string(dots) + "\n";
    XChangeProperty(display_, DefaultRootWindow(display_), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                    int(text.size()));
    XSync(display_, False);
  }
  ~DisplayDensity() { XCloseDisplay(display_); }
  DisplayDensity(const DisplayDensity&) = delete;
  DisplayDensity& operator=(const DisplayDensity&) = delete;

 private:
  Display* display_;
};
