// The files that the window writes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "viewer/display_transform.h"
#include "viewer/window/background_render.h"
#include "viewer/window/shown_settings.h"

namespace lumivec {

// What the window displays, with its settings in the header. Returns the file. Throws CommandError.
std::filesystem::path write_screenshot(const std::filesystem::path& folder, const Picture& pixels,
                                       const ShownPicture& shown, const WindowFigures& figures);

// Renders the state's still as its view is now, into folder. All five layers are rendered and
// stored, whichever are shown, since what a file lacks cannot be looked at later; its beauty, and
// the PNG, are of those that are shown. scene: shown's.
void start_still(BackgroundRender& render, const std::shared_ptr<const LoadedScene>& scene,
                 const ShownPicture& shown, const std::filesystem::path& folder,
                 const std::function<void()>& on_news);

// Bytes that this process holds in memory; 0 where that cannot be known.
std::uint64_t resident_bytes();

}  // namespace lumivec
