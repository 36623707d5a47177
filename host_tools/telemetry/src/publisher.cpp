#include "publisher.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace hoap2::telemetry {
namespace {

constexpr std::chrono::milliseconds kLivePeriod{10};  // not paced: so often at most is a row shown live
constexpr std::chrono::seconds kRunPeriod{1};

template <std::size_t N>
constexpr std::size_t size_of(const place_t (&)[N]) {
  return N;
}

}  // namespace

Filler::Filler(const place_t *places, std::size_t count, const std::int32_t *columns) {
  for (std::size_t i = 0; i < count; ++i) {
    const place_t &place = places[i];
    const std::size_t bytes = place.real ? sizeof(double) : sizeof(std::int32_t);
    for (int k = 0; k < place.count; ++k, ++columns) {
      auto &runs =
          *columns >= 0 ? (place.real ? reals_ : ints_) : (place.real ? missing_reals_ : missing_ints_);
      const std::size_t offset = place.offset + static_cast<std::size_t>(k) * bytes;
      if (!runs.empty() && *columns >= 0) {
        Run &last = runs.back();
        if (last.offset + static_cast<std::size_t>(last.count) * bytes == offset &&
            last.column + last.count == *columns) {
          ++last.count;
          continue;
        }
      }
      runs.push_back({offset, *columns, 1});
    }
  }
}

void Filler::clear(void *message) const {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::int32_t zero = 0;
  auto *bytes = static_cast<std::uint8_t *>(message);
  for (const Run &run : missing_reals_) std::memcpy(bytes + run.offset, &nan, sizeof nan);
  for (const Run &run : missing_ints_) std::memcpy(bytes + run.offset, &zero, sizeof zero);
}

void Filler::fill(void *message, const double *real, const std::int32_t *integer) const {
  auto *bytes = static_cast<std::uint8_t *>(message);
  for (const Run &run : reals_) {
    std::memcpy(bytes + run.offset, real + run.column, static_cast<std::size_t>(run.count) * sizeof(double));
  }
  for (const Run &run : ints_) {
    std::memcpy(bytes + run.offset, integer + run.column,
                static_cast<std::size_t>(run.count) * sizeof(std::int32_t));
  }
}

Publisher::Publisher(const hoap2_telemetry_config_t &config)
    : config_(config),
      log_(config.log_path, config.paced != 0),
      live_(config.live_url),
      fill_state_(STATE_PLACES, size_of(STATE_PLACES), config.columns[HOAP2_TELEMETRY_STATE]),
      fill_gait_(GAIT_PLACES, size_of(GAIT_PLACES), config.columns[HOAP2_TELEMETRY_GAIT]),
      fill_truth_(TRUTH_PLACES, size_of(TRUTH_PLACES), config.columns[HOAP2_TELEMETRY_TRUTH]) {
  fill_state_.clear(&state_);
  fill_gait_.clear(&gait_);
  fill_truth_.clear(&truth_);
}

// The message in buffer_, to the sinks. What tells of an earlier tick stands in the log where it was said.
void Publisher::pass(Channel &channel, std::int64_t tick, int length, bool numbered, int where) {
  const std::int64_t log_tick = std::max(tick, next_ - 1);
  if ((where & HOAP2_TELEMETRY_TO_LOG) != 0) {
    log_.write(channel, log_tick * config_.tick_us, buffer_.data(), length, numbered);
  }
  if ((where & HOAP2_TELEMETRY_LIVE) != 0)
    live_.send(channel, log_tick * config_.tick_us, buffer_.data(), length, numbered);
}

bool Publisher::live_due(Clock::time_point now) {
  if (!live_.open()) return false;
  if (now - live_at_ < kLivePeriod) return false;
  live_at_ = now;
  return true;
}

void Publisher::rows(std::int64_t end, double lag_us, std::int64_t overruns) {
  const Clock::time_point start = Clock::now();
  health_.lag_us = lag_us;
  health_.overruns = overruns;
  const bool every = live_.open() && config_.paced != 0;
  const bool last = !every && live_due(start);
  while (next_ < end) {
    const std::int64_t tick = next_++;
    row(tick, every || (last && tick == end - 1));
  }
  repeat_run(start);
  log_.pass();
  live_.pass();
  spent_ns_ += std::chrono::nanoseconds(Clock::now() - start).count();
}

void Publisher::row(std::int64_t tick, bool live) {
  const double *real = config_.real + tick * config_.real_stride;
  const std::int32_t *integer = config_.integer + tick * config_.integer_stride;
  fill_gait_.fill(&gait_, real, integer);
  if (log_.open() || live) fill_state_.fill(&state_, real, integer);
  put(state_channel_, state_, tick, live);
  put(gait_channel_, gait_, tick, live);
  if (tick % kSlowTicks == 0) {
    fill_truth_.fill(&truth_, real, integer);
    put(truth_channel_, truth_, tick, live);
    health(tick, live, hoap2_lcm::health_t::RUNNING);
  }
  events(tick, real);
}

// Mean and largest duration of the steps since the last health message, in us.
static void spread(const std::int64_t *ns, std::int64_t first, std::int64_t end, double &mean_us,
                   double &most_us) {
  std::int64_t sum = 0, most = 0;
  for (std::int64_t k = first; k < end; ++k) {
    sum += ns[k];
    most = std::max(most, ns[k]);
  }
  mean_us = end > first ? 1e-3 * static_cast<double>(sum) / static_cast<double>(end - first) : 0.0;
  most_us = 1e-3 * static_cast<double>(most);
}

void Publisher::health(std::int64_t tick, bool live, std::int32_t state) {
  const Clock::time_point now = Clock::now();
  const std::int64_t ticks = tick - health_tick_;
  const double wall_us = 1e-3 * static_cast<double>(std::chrono::nanoseconds(now - health_at_).count());
  if (ticks > 0) {
    spread(config_.controller_ns, health_tick_, tick, health_.controller_us, health_.controller_max_us);
    spread(config_.plant_ns, health_tick_, tick, health_.plant_us, health_.plant_max_us);
    health_.telemetry_us =
        1e-3 * static_cast<double>(spent_ns_ - health_spent_ns_) / static_cast<double>(ticks);
    health_.real_time_factor = wall_us > 0.0 ? static_cast<double>(ticks * config_.tick_us) / wall_us : 0.0;
  }
  health_tick_ = tick;
  health_at_ = now;
  health_spent_ns_ = spent_ns_;
  health_.published = live_.published();
  health_.dropped = live_.dropped();
  health_.decimated = decimated();
  health_.fault = gait_.fault;
  health_.paced = config_.paced;
  health_.state = state;
  put(health_channel_, health_, tick, live);
}

std::int64_t Publisher::decimated() const {
  if (!live_.open()) return 0;
  return state_channel_.decimated + gait_channel_.decimated + truth_channel_.decimated +
         health_channel_.decimated;
}

void Publisher::send(const char *channel, const void *data, int length, std::int64_t tick, int where) {
  const bool numbered = std::strcmp(channel, "HOAP2_COMMAND") != 0;
  const auto *bytes = static_cast<const std::uint8_t *>(data);
  if (length < (numbered ? static_cast<int>(kHeaderEnd) : 1)) return;
  const bool is_run = channel == run_channel_.name;
  Channel &to = is_run ? run_channel_
                : channel == event_channel_.name
                    ? event_channel_
                    : others_.try_emplace(channel, Channel{channel}).first->second;
  buffer_.assign(bytes, bytes + length);
  const std::int64_t of = tick >= 0 ? tick : std::max<std::int64_t>(next_ - 1, 0);
  if (numbered) {
    put_int64(buffer_.data() + kRunIdAt, config_.run_id);
    put_int64(buffer_.data() + kTickAt, of);
    put_int64(buffer_.data() + kTimeAt, of * config_.tick_us);
  }
  if (is_run) {
    run_ = buffer_;
    run_at_ = Clock::now();
  }
  pass(to, of, length, numbered, where);
  live_.pass();
}

// Who comes late learns within a second which run this is.
void Publisher::repeat_run(Clock::time_point now) {
  if (!live_.open() || run_.empty() || now - run_at_ < kRunPeriod) return;
  const std::vector<std::uint8_t> run = run_;
  send(run_channel_.name.c_str(), run.data(), static_cast<int>(run.size()), -1, HOAP2_TELEMETRY_LIVE);
}

void Publisher::finish(bool ended) {
  if (ended && next_ > 0) health(next_ - 1, live_.open(), hoap2_lcm::health_t::ENDED);
  log_.close();
  live_.finish();
}

void Publisher::counts(hoap2_telemetry_counts_t *counts) const {
  *counts = {log_.count(),    live_.published(), live_.dropped(),  decimated(),
             live_.waiting(), spent_ns_,         live_.sender_ns()};
}

}  // namespace hoap2::telemetry
