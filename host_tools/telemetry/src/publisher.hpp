// Rows of a run's signals as messages, with the events that they show.
#ifndef HOAP2_TELEMETRY_PUBLISHER_HPP
#define HOAP2_TELEMETRY_PUBLISHER_HPP

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "generated/places.hpp"
#include "hoap2_lcm/event_t.hpp"
#include "hoap2_lcm/health_t.hpp"
#include "hoap2_telemetry/telemetry.h"
#include "sinks.hpp"

namespace hoap2::telemetry {

constexpr std::int64_t kSlowTicks = 10;  // truth and health: every tenth tick

// Copies the values of a row into the members of a message.
class Filler {
 public:
  Filler(const place_t *places, std::size_t count, const std::int32_t *columns);
  // Members that no column feeds: NaN, or 0 for integers.
  void clear(void *message) const;
  void fill(void *message, const double *real, const std::int32_t *integer) const;

 private:
  struct Run {  // neighbours in the row that are neighbours in the message
    std::size_t offset;
    std::int32_t column;
    std::int32_t count;
  };
  std::vector<Run> reals_, ints_, missing_reals_, missing_ints_;
};

class Publisher {
 public:
  explicit Publisher(const hoap2_telemetry_config_t &config);
  ~Publisher() { finish(false); }  // while the channels' names are there
  Publisher(const Publisher &) = delete;
  Publisher &operator=(const Publisher &) = delete;
  void rows(std::int64_t end, double lag_us, std::int64_t overruns);
  void send(const char *channel, const void *data, int length, std::int64_t tick, int where);
  void finish(bool ended);
  void counts(hoap2_telemetry_counts_t *counts) const;
  const std::string &problem() const { return log_.problem(); }
  Live &live() { return live_; }

 private:
  using Clock = std::chrono::steady_clock;
  void row(std::int64_t tick, bool live);
  template <class Message>
  void put(Channel &channel, Message &message, std::int64_t tick, bool live);
  void pass(Channel &channel, std::int64_t tick, int length, bool numbered, int where);
  void events(std::int64_t tick, const double *real);
  void event(std::int64_t tick, const char *kind, const std::string &text);
  void health(std::int64_t tick, bool live, std::int32_t state);
  void repeat_run(Clock::time_point now);
  bool live_due(Clock::time_point now);
  std::int64_t decimated() const;

  hoap2_telemetry_config_t config_;
  Log log_;
  Live live_;
  Filler fill_state_, fill_gait_, fill_truth_;
  hoap2_lcm::state_t state_{};
  hoap2_lcm::gait_t gait_{};
  hoap2_lcm::truth_t truth_{};
  hoap2_lcm::health_t health_{};
  Channel state_channel_{"HOAP2_STATE"}, gait_channel_{"HOAP2_GAIT"}, truth_channel_{"HOAP2_TRUTH"},
      health_channel_{"HOAP2_HEALTH"}, event_channel_{"HOAP2_EVENT"}, run_channel_{"HOAP2_RUN"};
  std::map<std::string, Channel> others_;
  std::vector<std::uint8_t> buffer_, run_;
  std::int64_t next_ = 0, health_tick_ = 0, spent_ns_ = 0, health_spent_ns_ = 0;
  Clock::time_point live_at_{}, run_at_{}, health_at_ = Clock::now();
  std::int32_t step_ = 0, fault_ = 0, mode_ = -1;
  bool pushed_ = false;
};

template <class Message>
void Publisher::put(Channel &channel, Message &message, std::int64_t tick, bool live) {
  if (!live) ++channel.decimated;
  if (!log_.open() && !live) return;
  message.run_id = config_.run_id;
  message.tick = tick;
  message.time_us = tick * config_.tick_us;
  const int length = message.getEncodedSize();
  buffer_.resize(static_cast<std::size_t>(length));
  message.encode(buffer_.data(), 0, length);
  pass(channel, tick, length, true, HOAP2_TELEMETRY_TO_LOG | (live ? HOAP2_TELEMETRY_LIVE : 0));
}

}  // namespace hoap2::telemetry
#endif
