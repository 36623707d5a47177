// A tick takes no memory: every way to the heap is counted while hoap2_plant_step runs. An executable
// of its own, as it stands between the whole process and the C library's allocator.
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>

#include "ground_scenes.h"

namespace {

thread_local bool counting = false;
thread_local int taken = 0;

void count() { taken += counting ? 1 : 0; }

}  // namespace

extern "C" {

// The C library's own, under the names that it keeps for such replacements.
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t number, std::size_t size);
void *__libc_realloc(void *block, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

void *malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void *calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void *realloc(void *block, std::size_t size) {
  count();
  return __libc_realloc(block, size);
}
void *memalign(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void *aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void **block, std::size_t alignment, std::size_t size) {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

}  // extern "C"

namespace hoap2_sim {
namespace {

int taken_in_a_step(Rig *rig) {
  taken = 0;
  counting = true;
  const int failed = hoap2_plant_step(rig->plant(), &rig->inputs);
  counting = false;
  EXPECT_EQ(0, failed) << hoap2_plant_error(rig->plant());
  return taken;
}

TEST(Allocation, IsSeenByTheCounters) {
  taken = 0;
  counting = true;
  void *volatile taken_10 =
      std::malloc(10);  // volatile: the compiler may leave out a pair that nobody looks at
  free(taken_10);
  double *volatile number = new double(3.0);
  delete number;
  void *volatile taken_15 = std::calloc(3, 5);
  free(taken_15);
  const std::string text(100, 'x');
  counting = false;
  EXPECT_EQ(4, taken) << text;
  // and inside ODE's library, which makes its bodies on the heap
  counting = true;
  Rig rig;
  rig.start();
  counting = false;
  EXPECT_GT(taken, 50);
}

// The first tick of a new world may take memory: ODE's workspace.
class AllocationOnTheGround : public ::testing::TestWithParam<GroundScene> {};

TEST_P(AllocationOnTheGround, NoTickTakesMemory) {
  Rig rig;
  GetParam().start(&rig);
  rig.step();
  for (int tick = 1; tick < GetParam().ticks; ++tick) ASSERT_EQ(0, taken_in_a_step(&rig)) << tick;
}

INSTANTIATE_TEST_SUITE_P(Ground, AllocationOnTheGround, ::testing::ValuesIn(kGroundScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Lying, AllocationOnTheGround, ::testing::ValuesIn(kLyingScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Twice, AllocationOnTheGround, ::testing::ValuesIn(kTwiceSupportedScenes),
                         scene_name);

TEST(Allocation, NoTickOfAWalkTakesMemory) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.params.roll_stiffness_Nm_rad = 150.0;
  rig.params.push_link[0] = HOAP2_L_CHEST;
  rig.params.push_force_W_N[0][1] = 2.0;
  rig.params.push_start_s[0] = 2.5;
  rig.params.push_duration_s[0] = 0.2;
  Walker walker(&rig);
  walker.start();
  rig.step();
  for (int tick = 1; walker.outputs.step_index < 5; ++tick) {
    ASSERT_LT(tick, 6000) << "it must walk";
    walker.command();
    ASSERT_EQ(0, taken_in_a_step(&rig)) << tick;
  }
}

TEST(Allocation, NoTickAfterGoingBackTakesMemory) {
  Rig rig;
  fall_askew(&rig);
  rig.step(300);
  const State saved = rig.state();
  rig.step(300);
  ASSERT_EQ(0, rig.restore(saved));
  for (int tick = 0; tick < 100; ++tick) ASSERT_EQ(0, taken_in_a_step(&rig)) << tick;
}

}  // namespace
}  // namespace hoap2_sim
