#include "outbox.hpp"

#include <pthread.h>

#include <csignal>
#include <ctime>
#include <utility>

namespace hoap2::telemetry {

void Outbox::Batch::append(const Batch &other) {
  const std::size_t from = bytes.size();
  bytes.insert(bytes.end(), other.bytes.begin(), other.bytes.end());
  for (Item item : other.items) {
    item.offset += from;
    items.push_back(item);
  }
}

void Outbox::Batch::clear() {
  items.clear();
  bytes.clear();
}

Outbox::Outbox(Deliver deliver, std::size_t limit, bool drops)
    : deliver_(std::move(deliver)), limit_(limit), drops_(drops) {
  // the signals of the process are for its main thread
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Outbox::put(const Message &message) {
  ++put_;
  here_.items.push_back({message.channel, message.time_us, here_.bytes.size(), message.length});
  here_.bytes.insert(here_.bytes.end(), message.data, message.data + message.length);
}

void Outbox::pass() {
  if (here_.items.empty()) return;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto has_room = [this] { return waiting_.bytes.size() + here_.bytes.size() <= limit_; };
    if (!drops_) emptied_.wait(lock, [&] { return has_room() || waiting_.items.empty(); });
    if (!drops_ || has_room()) {
      waiting_.append(here_);
    } else {
      dropped_ += static_cast<std::int64_t>(here_.items.size());
    }
  }
  here_.clear();
  filled_.notify_one();
}

void Outbox::work() {
  Batch batch;
  bool ends = false;
  while (!ends) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      filled_.wait(lock, [this] { return ends_ || !waiting_.items.empty(); });
      std::swap(batch, waiting_);
      ends = ends_ && batch.items.empty();
    }
    emptied_.notify_one();
    for (const Batch::Item &item : batch.items) {
      deliver_({item.channel, item.time_us, batch.bytes.data() + item.offset, item.length});
      ++delivered_;
    }
    batch.clear();
  }
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  thread_ns_ = static_cast<std::int64_t>(spent.tv_sec) * 1000000000 + spent.tv_nsec;
}

void Outbox::finish() {
  if (!thread_.joinable()) return;
  pass();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  filled_.notify_one();
  thread_.join();
}

}  // namespace hoap2::telemetry
