// The files that the window writes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "viewer/display_transform.h"
#include "viewer/window/background_render.h"
#include "viewer/window/window_state.h"

namespace lumivec {

// FOLDER/STEM_0001EXTENSION, with the first number that no file has.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);

// How a picture was shown, as options of render.
std::string settings_text(const WindowState& state, const DisplayOptions& display);

// What the window displays, with its settings in the header. Returns the file. Throws CommandError.
std::filesystem::path write_screenshot(const std::filesystem::path& folder, const Picture& shown,
                                       const LoadedScene& scene, const WindowState& state,
                                       const DisplayOptions& display, const WindowFigures& figures);

// Renders the state's still as its view is now, into folder. size: the window's picture.
void start_still(BackgroundRender& render, const std::shared_ptr<const LoadedScene>& scene,
                 const WindowState& state, const DisplayOptions& display,
                 const std::filesystem::path& folder, const PictureSize& size,
                 const std::function<void()>& on_news);

// Bytes that this process holds in memory; 0 where that cannot be known.
std::uint64_t resident_bytes();

}  // namespace lumivec
