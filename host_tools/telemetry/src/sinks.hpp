// Where messages go: a log file and a live LCM connection. Each may be absent.
#ifndef HOAP2_TELEMETRY_SINKS_HPP
#define HOAP2_TELEMETRY_SINKS_HPP

#include <lcm/eventlog.h>
#include <lcm/lcm.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

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
  // Empty: no log. Throws std::runtime_error.
  explicit Log(const char *path);
  bool open() const { return log_ != nullptr; }
  // data: with the common header when `numbered`; its sequence number is filled in.
  void write(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered);
  void flush();
  // Writes what is left; the file is whole when problem() is still empty.
  void close();
  std::int64_t count() const { return count_; }
  const std::string &problem() const { return problem_; }

 private:
  struct Destroy {
    void operator()(lcm_eventlog_t *log) const { lcm_eventlog_destroy(log); }
  };
  void fail();
  std::vector<char> buffer_;  // of the file: outlives it
  std::unique_ptr<lcm_eventlog_t, Destroy> log_;
  std::int64_t count_ = 0;
  std::string problem_;
};

// Sends from a thread of its own, so that a run never waits for a transport. What it cannot take in time is
// dropped and leaves a gap in the sequence numbers.
class Live {
 public:
  // Empty: not live. Throws std::runtime_error.
  explicit Live(const char *url);
  ~Live() { finish(); }
  Live(const Live &) = delete;
  Live &operator=(const Live &) = delete;
  bool open() const { return lcm_ != nullptr; }
  // Put by until the next pass().
  void send(Channel &channel, std::uint8_t *data, int length, bool numbered);
  // Hands on what was put by.
  void pass();
  // Sends what is left, and ends the thread; the connection stays.
  void finish();
  lcm_t *connection() { return lcm_.get(); }
  std::int64_t published() const { return published_; }
  std::int64_t dropped() const { return dropped_; }
  std::int64_t waiting() const { return taken_ - published_ - dropped_; }
  std::int64_t sender_ns() const { return sender_ns_; }

 private:
  struct Destroy {
    void operator()(lcm_t *lcm) const { lcm_destroy(lcm); }
  };
  struct Batch {
    struct Item {
      const char *channel;  // names outlive the connection
      std::size_t offset;
      unsigned length;
    };
    std::vector<Item> items;
    std::vector<std::uint8_t> bytes;
    void clear();
    void append(const Batch &other);
  };
  void work();
  void send_all(const Batch &batch);
  std::unique_ptr<lcm_t, Destroy> lcm_;
  Batch here_;     // put by; the caller's
  Batch waiting_;  // under mutex_
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ends_ = false;  // under mutex_
  std::atomic<std::int64_t> taken_{0}, published_{0}, dropped_{0}, sender_ns_{0};
  std::thread thread_;
};

}  // namespace hoap2::telemetry
#endif
