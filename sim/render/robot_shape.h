// The look of HOAP-2: which rounded solids stand for each link.
#ifndef HOAP2_RENDER_ROBOT_SHAPE_H
#define HOAP2_RENDER_ROBOT_SHAPE_H

#include "mesh.h"

namespace hoap2 {

enum class Detail { picture, shadow };

// The whole robot in link coordinates; Vertex::link is the index of the link in hoap2.json.
Mesh robot_mesh(Detail detail);

}  // namespace hoap2
#endif
