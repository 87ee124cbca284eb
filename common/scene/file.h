#pragma once
// Scenes as files: TOML, or a picture that carries it along.

#include <string>

#include "common/image/image.h"
#include "common/scene/scene.h"

namespace shearwater::scene {

// Of a TOML file, or of a PNG that write_picture() has written.
base::Result<Scene> read(const std::string& path);
// In the place of whatever the file held, if that is a scene, or nothing: no other file is written over.
base::Status write(const std::string& path, const Scene& scene);
// A picture of the scene, with it.
base::Status write_picture(const std::string& path, const Scene& scene,
                           const image::Image<image::Rgba8>& picture);

}  // namespace shearwater::scene
