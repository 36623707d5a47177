// Where messages go: a log file and a live LCM connection. Each may be absent.
#ifndef HOAP2_TELEMETRY_SINKS_HPP
#define HOAP2_TELEMETRY_SINKS_HPP

#include <lcm/eventlog.h>
#include <lcm/lcm.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "outbox.hpp"

namespace hoap2::telemetry {

// A channel counts its messages in the log and live, each from 0.
struct Channel {
  std::string name;
  std::int64_t logged = 0;
  std::int64_t sent = 0;
  std::int64_t decimated = 0;
};

// Writes a number as LCM does (big-endian) into an encoded message.
void put_int64(std::uint8_t *at, std::int64_t value);

// Places in every encoded message that has the common header.
enum { kRunIdAt = 8, kSequenceAt = 16, kTickAt = 24, kTimeAt = 32, kHeaderEnd = 40 };

class Log {
 public:
  // No path: no log. paced: written by a thread, for a disk may make its writer wait. Throws
  // std::runtime_error.
  Log(const char *path, bool paced);
  bool open() const { return log_ != nullptr && !failed_; }
  // data: with the common header when `numbered`; its sequence number is filled in.
  void write(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered);
  // Lets the thread have what was written.
  void pass();
  // Writes what is left; the file is whole when problem() is still empty.
  void close();
  std::int64_t count() const { return count_; }
  // To be asked after close().
  const std::string &problem() const { return problem_; }

 private:
  struct Destroy {
    void operator()(lcm_eventlog_t *log) const { lcm_eventlog_destroy(log); }
  };
  void deliver(const Outbox::Message &message);
  void fail();
  std::vector<char> buffer_;  // of the file: outlives it
  std::unique_ptr<lcm_eventlog_t, Destroy> log_;
  std::atomic<std::int64_t> count_{0};
  std::atomic<bool> failed_{false};
  std::string problem_;
  std::unique_ptr<Outbox> outbox_;
};

// Sends from a thread, so that a run never waits for a transport. What it cannot take in time is dropped and
// leaves a gap in the sequence numbers.
class Live {
 public:
  // No url: not live. Throws std::runtime_error.
  explicit Live(const char *url);
  bool open() const { return lcm_ != nullptr; }
  // Put by until the next pass().
  void send(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered);
  void pass();
  // Sends what is left, and ends the thread; the connection stays.
  void finish();
  lcm_t *connection() { return lcm_.get(); }
  std::int64_t published() const { return published_; }
  std::int64_t dropped() const { return refused_ + (outbox_ ? outbox_->dropped() : 0); }
  std::int64_t waiting() const { return outbox_ ? outbox_->waiting() : 0; }
  std::int64_t sender_ns() const { return outbox_ ? outbox_->thread_ns() : 0; }

 private:
  struct Destroy {
    void operator()(lcm_t *lcm) const { lcm_destroy(lcm); }
  };
  void deliver(const Outbox::Message &message);
  std::unique_ptr<lcm_t, Destroy> lcm_;
  std::atomic<std::int64_t> published_{0}, refused_{0};
  std::chrono::steady_clock::time_point breath_{};  // the thread's
  int at_once_ = 0;                                 // the thread's
  std::unique_ptr<Outbox> outbox_;
};

}  // namespace hoap2::telemetry
#endif
