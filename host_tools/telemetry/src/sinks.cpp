#include "sinks.hpp"

#include <pthread.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <stdexcept>

namespace hoap2::telemetry {
namespace {

constexpr std::size_t kFileBuffer = 1U << 18U;  // some 100 ticks a write
constexpr int kAtOnce = 16;                     // messages, more than a batch of a paced run has
constexpr std::chrono::milliseconds kBreath{1};
constexpr std::size_t kWaitingBytes = 1U << 22U;  // not sent yet: some 2 s at full rate

}  // namespace

void put_int64(std::uint8_t *at, std::int64_t value) {
  auto bits = static_cast<std::uint64_t>(value);
  for (int i = 7; i >= 0; --i) {
    at[i] = static_cast<std::uint8_t>(bits & 0xffU);
    bits >>= 8U;
  }
}

Log::Log(const char *path) {
  if (path == nullptr) return;
  log_.reset(lcm_eventlog_create(path, "w"));
  if (!log_) throw std::runtime_error(std::string("cannot write ") + path + ": " + std::strerror(errno));
  buffer_.resize(kFileBuffer);
  std::setvbuf(log_->f, buffer_.data(), _IOFBF, buffer_.size());
}

void Log::write(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered) {
  if (!log_) return;
  if (numbered) put_int64(data + kSequenceAt, channel.logged);
  lcm_eventlog_event_t event{};
  event.timestamp = time_us;
  event.channellen = static_cast<std::int32_t>(channel.name.size());
  event.datalen = length;
  event.channel = channel.name.data();
  event.data = data;
  errno = 0;
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) return fail();
  ++channel.logged;
  ++count_;
}

void Log::fail() {
  problem_ = std::string("the log ends early: ") + std::strerror(errno != 0 ? errno : EIO);
  log_.reset();
}

void Log::flush() {
  errno = 0;
  if (log_ && std::fflush(log_->f) != 0) fail();
}

void Log::close() {
  flush();
  log_.reset();
}

void Live::Batch::clear() {
  items.clear();
  bytes.clear();
}

void Live::Batch::append(const Batch &other) {
  const std::size_t from = bytes.size();
  bytes.insert(bytes.end(), other.bytes.begin(), other.bytes.end());
  for (Item item : other.items) {
    item.offset += from;
    items.push_back(item);
  }
}

Live::Live(const char *url) {
  if (url == nullptr) return;
  lcm_.reset(lcm_create(url));
  if (!lcm_) throw std::runtime_error(std::string("LCM cannot open ") + url);
  // the signals of the process are for its main thread
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Live::send(Channel &channel, std::uint8_t *data, int length, bool numbered) {
  if (!lcm_) return;
  if (numbered) put_int64(data + kSequenceAt, channel.sent);
  ++channel.sent;
  here_.items.push_back({channel.name.c_str(), here_.bytes.size(), static_cast<unsigned>(length)});
  here_.bytes.insert(here_.bytes.end(), data, data + length);
}

void Live::pass() {
  if (here_.items.empty()) return;
  taken_ += static_cast<std::int64_t>(here_.items.size());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.bytes.size() + here_.bytes.size() <= kWaitingBytes) {
      waiting_.append(here_);
    } else {
      dropped_ += static_cast<std::int64_t>(here_.items.size());
    }
  }
  here_.clear();
  changed_.notify_one();
}

void Live::work() {
  Batch batch;
  bool ends = false;
  while (!ends) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || !waiting_.items.empty(); });
      std::swap(batch, waiting_);
      ends = ends_ && batch.items.empty();
    }
    send_all(batch);
    batch.clear();
  }
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  sender_ns_ = static_cast<std::int64_t>(spent.tv_sec) * 1000000000 + spent.tv_nsec;
}

void Live::send_all(const Batch &batch) {
  int sent_at_once = 0;
  for (const Batch::Item &item : batch.items) {
    // after a wait the backlog goes out evenly: listeners hold little (lcm-logger 30 messages)
    if (++sent_at_once > kAtOnce) {
      std::this_thread::sleep_for(kBreath);
      sent_at_once = 1;
    }
    const bool sent =
        lcm_publish(lcm_.get(), item.channel, batch.bytes.data() + item.offset, item.length) == 0;
    ++(sent ? published_ : dropped_);
  }
}

void Live::finish() {
  if (!thread_.joinable()) return;
  pass();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace hoap2::telemetry
