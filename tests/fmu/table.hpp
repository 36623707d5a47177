// The product's table of fields, for the tests of either FMI version.
#pragma once

#include <stdexcept>
#include <string>

extern "C" {
#include "fmu/product.h"
}

inline const hoap2_fmu_field_t& field_named(const std::string& name) {
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    if (name == HOAP2_FMU_PRODUCT.fields[i].name) return HOAP2_FMU_PRODUCT.fields[i];
  }
  throw std::runtime_error("no field " + name);
}

inline unsigned row_of(const hoap2_fmu_field_t& field) {
  return static_cast<unsigned>(&field - HOAP2_FMU_PRODUCT.fields) + 1;
}

// First field of a group and kind with at least `count` elements.
inline const hoap2_fmu_field_t& some_field(int group, int kind, uint32_t count = 1) {
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group == group && f.kind == kind && f.count >= count && !f.tunable) return f;
  }
  throw std::runtime_error("no such field");
}

inline bool is_controller() { return std::string(HOAP2_FMU_PRODUCT.name) == "hoap2_controller"; }

inline unsigned tunable_fields() {
  unsigned count = 0;
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i)
    count += HOAP2_FMU_PRODUCT.fields[i].tunable ? 1 : 0;
  return count;
}
