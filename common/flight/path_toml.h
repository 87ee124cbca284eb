#pragma once
// A flight path as a person writes it. What a key does not say is as in the key before; the first begins from
// the defaults of view::Orbit and the default transfer function.
//
//   fps = 25
//
//   [[cube]]                     # none: what a server shows, or the cube of the command line
//   path = "galaxy.fits"         # beside this file; then, as the options of that name: hdu plane range
//                                # percentile stretch bits spacing
//   [[key]]
//   time = 0.0                   # seconds
//   cube = 1                     # from 1, in the order above
//   azimuth = 30.0
//   elevation = 20.0             # degrees
//   roll = 0.0
//   distance = 300.0             # world units; 0: the whole cube is seen
//   target = [0.0, 0.0, 0.0]     # world
//   projection = "perspective"   # or "parallel"
//   fov = 30.0
//   limits = [0.0, 4.5]          # of values, in the cube's unit; none, and after a cut: as the cube is
//   loaded stretch = "linear"           # between them tf = "shell.toml"            # beside this file; or as
//   a table of its own, [key.tf]

#include <string>
#include <string_view>

#include "common/flight/path.h"

namespace shearwater::flight {

// Reads the path and the files of transfer functions it names. Cubes' paths are made to lead from here.
base::Result<Path> read_path(const std::string& file);
// The same from a text; `folder` is where other files lie.
base::Result<Path> path_from_toml(std::string_view text, const std::string& source,
                                  const std::string& folder);

// One text with everything in it; paths of cubes stay as they are.
std::string to_toml(const Path& path);

}  // namespace shearwater::flight
