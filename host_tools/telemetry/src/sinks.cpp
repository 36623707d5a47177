#include "sinks.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace hoap2::telemetry {
namespace {

constexpr std::size_t kFileBuffer = 1U << 18U;  // some 100 ticks a write
constexpr int kAtOnce = 16;                     // messages a breath, more than a batch of a paced run has
constexpr std::chrono::milliseconds kBreath{1};
constexpr std::size_t kLiveBytes = 1U << 22U;  // that wait to be sent: some 2 s at full rate
constexpr std::size_t kLogBytes = 1U << 26U;   // that wait for the disk: some 30 s

}  // namespace

void put_int64(std::uint8_t *at, std::int64_t value) {
  auto bits = static_cast<std::uint64_t>(value);
  for (int i = 7; i >= 0; --i) {
    at[i] = static_cast<std::uint8_t>(bits & 0xffU);
    bits >>= 8U;
  }
}

Log::Log(const char *path, bool paced) {
  if (path == nullptr) return;
  log_.reset(lcm_eventlog_create(path, "w"));
  if (!log_) throw std::runtime_error(std::string("cannot write ") + path + ": " + std::strerror(errno));
  buffer_.resize(kFileBuffer);
  std::setvbuf(log_->f, buffer_.data(), _IOFBF, buffer_.size());
  if (paced) {
    outbox_ = std::make_unique<Outbox>([this](const Outbox::Message &m) { deliver(m); }, kLogBytes, false);
  }
}

void Log::write(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered) {
  if (!open()) return;
  if (numbered) put_int64(data + kSequenceAt, channel.logged);
  ++channel.logged;
  const Outbox::Message message{&channel.name, time_us, data, length};
  if (outbox_) {
    outbox_->put(message);
  } else {
    deliver(message);
  }
}

void Log::deliver(const Outbox::Message &message) {
  if (failed_) return;
  lcm_eventlog_event_t event{};
  event.timestamp = message.time_us;
  event.channellen = static_cast<std::int32_t>(message.channel->size());
  event.datalen = message.length;
  event.channel = const_cast<char *>(message.channel->c_str());  // liblcm only reads them
  event.data = const_cast<std::uint8_t *>(message.data);
  errno = 0;
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) return fail();
  ++count_;
}

void Log::fail() {
  problem_ = std::string("the log ends early: ") + std::strerror(errno != 0 ? errno : EIO);
  failed_ = true;
}

void Log::pass() {
  if (outbox_) outbox_->pass();
}

void Log::close() {
  if (outbox_) outbox_->finish();
  errno = 0;
  if (open() && std::fflush(log_->f) != 0) fail();
  log_.reset();
}

Live::Live(const char *url) {
  if (url == nullptr) return;
  lcm_.reset(lcm_create(url));
  if (!lcm_) throw std::runtime_error(std::string("LCM cannot open ") + url);
  outbox_ = std::make_unique<Outbox>([this](const Outbox::Message &m) { deliver(m); }, kLiveBytes, true);
}

void Live::send(Channel &channel, std::int64_t time_us, std::uint8_t *data, int length, bool numbered) {
  if (!lcm_) return;
  if (numbered) put_int64(data + kSequenceAt, channel.sent);
  ++channel.sent;
  outbox_->put({&channel.name, time_us, data, length});
}

void Live::pass() {
  if (outbox_) outbox_->pass();
}

void Live::deliver(const Outbox::Message &message) {
  // a backlog goes out evenly: listeners hold little (lcm-logger 30 messages)
  const auto now = std::chrono::steady_clock::now();
  if (now - breath_ >= kBreath) {
    breath_ = now;
    at_once_ = 0;
  } else if (++at_once_ >= kAtOnce) {
    std::this_thread::sleep_for(kBreath);
    breath_ = std::chrono::steady_clock::now();
    at_once_ = 0;
  }
  const int refused =
      lcm_publish(lcm_.get(), message.channel->c_str(), message.data, static_cast<unsigned>(message.length));
  ++(refused == 0 ? published_ : refused_);
}

void Live::finish() {
  if (outbox_) outbox_->finish();
}

}  // namespace hoap2::telemetry
