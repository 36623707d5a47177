// Where links touch the ground: the sole boxes and the boxes of all other links
// against the floor plane and the terrain blocks. Links do not touch each other.
#ifndef HOAP2_SIM_TERRAIN_CONTACT_H
#define HOAP2_SIM_TERRAIN_CONTACT_H

#include <ode/ode.h>

#include "geometry.h"
#include "plant_state.h"
#include "terrain/floor.h"

namespace hoap2_sim {

constexpr int kMaxContacts = 320;

struct Contact {
  int link;
  double point_W_m[3];
  double normal_W[3];  // out of the ground
  double along_W[3];   // first friction direction: the link's x axis along the ground
  double depth_m;
};

struct ContactList {
  int count = 0;
  Contact at[kMaxContacts];
};

inline bool is_foot(int link) { return link == HOAP2_L_R_FOOT || link == HOAP2_L_L_FOOT; }

class Ground {
 public:
  Ground() = default;
  ~Ground();
  Ground(const Ground &) = delete;
  Ground &operator=(const Ground &) = delete;

  void build(const hoap2_plant_params_t &params);
  // axes_W: of all links, from the state's quaternions.
  void find_contacts(const State &state, const Mat3 axes_W[HOAP2_LINKS], ContactList *contacts) const;

 private:
  void clear();
  void touch_floor(const State &state, const Floor &floor, const Mat3 &axes_W, int link,
                   ContactList *contacts) const;
  void touch_block(const State &state, const Mat3 &axes_W, int link, int block, ContactList *contacts) const;

  int block_count_ = 0;
  dGeomID block_[16] = {};
  dGeomID link_box_[HOAP2_LINKS] = {};
};

}  // namespace hoap2_sim
#endif
