// The C interface.
#include "hoap2_telemetry/telemetry.h"

#include <cstdio>
#include <exception>

#include "publisher.hpp"

using hoap2::telemetry::place_t;
using hoap2::telemetry::Publisher;

struct hoap2_telemetry {
  explicit hoap2_telemetry(const hoap2_telemetry_config_t &config) : publisher(config) {}
  Publisher publisher;
  hoap2_telemetry_callback_t callback = nullptr;
};

namespace {

template <std::size_t N>
int32_t elements(const place_t (&places)[N]) {
  int32_t count = 0;
  for (const place_t &place : places) count += place.count;
  return count;
}

void hand_on(const lcm_recv_buf_t *received, const char *channel, void *user) {
  const auto *telemetry = static_cast<const hoap2_telemetry *>(user);
  telemetry->callback(channel, received->data, static_cast<int32_t>(received->data_size));
}

}  // namespace

hoap2_telemetry_t *hoap2_telemetry_open(const hoap2_telemetry_config_t *config, char *error,
                                        size_t error_size) {
  try {
    return new hoap2_telemetry(*config);
  } catch (const std::exception &what) {
    std::snprintf(error, error_size, "%s", what.what());
    return nullptr;
  }
}

void hoap2_telemetry_rows(hoap2_telemetry_t *telemetry, int64_t end, double lag_us, int64_t overruns) {
  telemetry->publisher.rows(end, lag_us, overruns);
}

void hoap2_telemetry_send(hoap2_telemetry_t *telemetry, const char *channel, const void *data, int32_t length,
                          int64_t tick, int32_t where) {
  telemetry->publisher.send(channel, data, length, tick, where);
}

void hoap2_telemetry_counts(const hoap2_telemetry_t *telemetry, hoap2_telemetry_counts_t *counts) {
  telemetry->publisher.counts(counts);
}

const char *hoap2_telemetry_problem(const hoap2_telemetry_t *telemetry) {
  return telemetry->publisher.problem().c_str();
}

int hoap2_telemetry_subscribe(hoap2_telemetry_t *telemetry, hoap2_telemetry_callback_t callback) {
  lcm_t *lcm = telemetry->publisher.live().connection();
  if (lcm == nullptr || callback == nullptr) return -1;
  telemetry->callback = callback;
  lcm_subscription_t *subscription = lcm_subscribe(lcm, "HOAP2_.*", hand_on, telemetry);
  if (subscription == nullptr) return -1;
  return lcm_subscription_set_queue_capacity(subscription, 0);
}

int hoap2_telemetry_poll(hoap2_telemetry_t *telemetry, int timeout_ms) {
  lcm_t *lcm = telemetry->publisher.live().connection();
  return lcm == nullptr ? -1 : lcm_handle_timeout(lcm, timeout_ms);
}

void hoap2_telemetry_finish(hoap2_telemetry_t *telemetry, int32_t ended) {
  telemetry->publisher.finish(ended != 0);
}

void hoap2_telemetry_destroy(hoap2_telemetry_t *telemetry) { delete telemetry; }

int32_t hoap2_telemetry_elements(int32_t message) {
  switch (message) {
    case HOAP2_TELEMETRY_STATE: return elements(hoap2::telemetry::STATE_PLACES);
    case HOAP2_TELEMETRY_GAIT: return elements(hoap2::telemetry::GAIT_PLACES);
    case HOAP2_TELEMETRY_TRUTH: return elements(hoap2::telemetry::TRUTH_PLACES);
    default: return -1;
  }
}

size_t hoap2_telemetry_config_size(void) { return sizeof(hoap2_telemetry_config_t); }
