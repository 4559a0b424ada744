#include "loader/gltf/images.h"

#include <tbb/parallel_for.h>

#include <exception>
#include <stdexcept>

#include "loader/error.h"
#include "loader/gltf/materials.h"
#include "loader/gltf/uri.h"
#include "loader/picture.h"

namespace lumivec::gltf {
namespace {

struct Task {
  std::size_t source = 0;  // index into the images of the file
  std::string where;
  ByteSource bytes;
  std::string problem;           // why there is no picture: a warning
  std::exception_ptr exception;  // what must end the loading
  lumivec::Image image;
};

ByteSource open_image(Context& context, Document& document, Buffers& buffers, const Task& task) {
  gltf::Image& image = document.images[task.source];
  if (image.view >= 0) return buffers.view(image.view);
  if (!image.uri) throw std::runtime_error("has neither a URI nor a buffer view");
  if (is_data_uri(*image.uri)) {
    auto bytes = decode_data_uri(*image.uri);
    *image.uri = std::string();
    if (!bytes) throw std::runtime_error("is a malformed data URI");
    return ByteSource::from_memory(std::move(*bytes));
  }
  if (is_remote_uri(*image.uri)) {
    throw std::runtime_error("would need a network: " + printable(*image.uri));
  }
  const auto file = find_file(context, task.where, *image.uri);
  if (!file) throw std::runtime_error("does not exist: " + printable(*image.uri));
  return ByteSource::open(*file, false);
}

void decode(Context& context, Task& task) {
  try {
    context.claim(task.bytes.size(), task.where);
    const auto bytes = task.bytes.read(0, task.bytes.size());
    task.image =
        decode_picture(bytes, [&](std::uint64_t size) { context.claim(size, task.where); });
  } catch (const SceneError&) {
    task.exception = std::current_exception();
  } catch (const std::bad_alloc&) {
    task.exception = std::current_exception();
  } catch (const std::exception& error) {
    task.problem = printable(error.what());
  }
  task.bytes = {};
}

std::vector<Task> open_used(Context& context, Document& document, Buffers& buffers, Scene& scene) {
  std::vector<bool> used(document.images.size());
  for (Material& material : scene.materials) {
    for_each_map(material, [&](const TextureMap& map) {
      if (map.image >= 0) used[static_cast<std::size_t>(map.image)] = true;
    });
  }
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    Task& task = tasks.emplace_back();
    task.source = i;
    task.where = pointer({"images", i});
    try {
      task.bytes = open_image(context, document, buffers, task);
    } catch (const SceneError&) {
      throw;
    } catch (const std::runtime_error& error) {
      task.problem = error.what();
    }
  }
  return tasks;
}

}  // namespace

void load_images(Context& context, Document& document, Buffers& buffers, Scene& scene) {
  std::vector<Task> tasks = open_used(context, document, buffers, scene);
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
    if (tasks[i].problem.empty()) decode(context, tasks[i]);
  });

  std::vector<int> indices(document.images.size(), -1);
  for (Task& task : tasks) {
    if (task.exception) std::rethrow_exception(task.exception);
    if (!task.problem.empty()) {
      context.warn(task.where, "image " + task.problem + "; its textures are left out");
      continue;
    }
    const gltf::Image& source = document.images[task.source];
    task.image.name = source.name;
    if (source.name.empty() && source.uri) task.image.name = *source.uri;
    indices[task.source] = static_cast<int>(scene.images.size());
    scene.images.push_back(std::move(task.image));
  }
  for (Material& material : scene.materials) {
    for_each_map(material, [&](TextureMap& map) {
      if (map.image < 0) return;
      map.image = indices[static_cast<std::size_t>(map.image)];
      if (map.image < 0) map = {};
    });
  }
}

}  // namespace lumivec::gltf
