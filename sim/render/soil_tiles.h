// The soil's mesh with no more triangles than its shape needs: most of a pool is untouched.
#ifndef HOAP2_RENDER_SOIL_TILES_H
#define HOAP2_RENDER_SOIL_TILES_H

#include <cstdint>
#include <vector>

#include "soil_surface.h"

namespace hoap2 {

struct SoilMesh {
  std::vector<SoilVertex> vertices;
  std::vector<uint32_t> indices;
};

// Tiles of kTile x kTile cells, halved again and again until each part keeps height and colour within
// 0.15 mm. Neighbours of different sizes do not meet exactly; a coarse sheet close below shows through
// these cracks, so that they have the colour of the ground.
SoilMesh soil_mesh(const SoilSurface &soil);

constexpr std::size_t kTile = 8;

}  // namespace hoap2
#endif
