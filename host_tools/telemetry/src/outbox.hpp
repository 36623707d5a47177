// Messages on their way to a sink, handed to a thread so that a run never waits for a network or a disk.
#ifndef HOAP2_TELEMETRY_OUTBOX_HPP
#define HOAP2_TELEMETRY_OUTBOX_HPP

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace hoap2::telemetry {

class Outbox {
 public:
  struct Message {
    const std::string *channel;  // outlives the outbox
    std::int64_t time_us;
    const std::uint8_t *data;
    int length;
  };
  using Deliver = std::function<void(const Message &)>;

  // deliver: called in the thread. limit: bytes that may wait. drops: what is beyond that is dropped; else
  // put() waits.
  Outbox(Deliver deliver, std::size_t limit, bool drops);
  ~Outbox() { finish(); }
  Outbox(const Outbox &) = delete;
  Outbox &operator=(const Outbox &) = delete;

  // Keeps a copy until the next pass().
  void put(const Message &message);
  // Hands on what was put.
  void pass();
  // Delivers what is left and ends the thread.
  void finish();
  std::int64_t dropped() const { return dropped_; }
  // Put and neither delivered nor dropped.
  std::int64_t waiting() const { return put_ - delivered_ - dropped_; }
  // Processor time of the thread, once finished.
  std::int64_t thread_ns() const { return thread_ns_; }

 private:
  struct Batch {
    struct Item {
      const std::string *channel;
      std::int64_t time_us;
      std::size_t offset;
      int length;
    };
    std::vector<Item> items;
    std::vector<std::uint8_t> bytes;
    void append(const Batch &other);
    void clear();
  };
  void work();

  Deliver deliver_;
  std::size_t limit_;
  bool drops_;
  Batch here_;         // the caller's
  Batch waiting_;      // under mutex_
  bool ends_ = false;  // under mutex_
  std::mutex mutex_;
  std::condition_variable filled_, emptied_;
  std::atomic<std::int64_t> put_{0}, delivered_{0}, dropped_{0}, thread_ns_{0};
  std::thread thread_;
};

}  // namespace hoap2::telemetry
#endif
