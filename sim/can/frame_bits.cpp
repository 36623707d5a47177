#include "can/frame_bits.h"

#include <array>

namespace hoap2_sim {
namespace {

constexpr int kRun = 5;                        // equal bits, after which a stuff bit comes
constexpr int kTail = 1 + 1 + 7 + 3;           // ACK slot, ACK delimiter, end of frame, intermission
constexpr int kStuffCountBits = 4;             // stuff bit count with its parity
constexpr std::uint32_t kCrc15Poly = 0x4599U;  // classic frames; their CRC is stuffed, so it matters

// The stuffing so far: last bit and how often it came, as bit << 3 | run.
struct Stuffing {
  std::uint8_t state = 1 << 3;  // bus idle: recessive, no run
  std::int32_t count = 0;

  void bit(int value) {
    int last = state >> 3, run = state & 7;
    if (run == kRun) {
      ++count;
      last = 1 - last;
      run = 1;
    }
    run = value == last ? run + 1 : 1;
    state = static_cast<std::uint8_t>(value << 3 | run);
  }
  void bits(std::uint32_t value, int width) {
    for (int i = width - 1; i >= 0; --i) bit(static_cast<int>(value >> i & 1U));
  }
  void byte(std::uint8_t value);
};

struct ByteStep {
  std::uint8_t state, stuffed;
};

// What a byte does to each state, found once for all at compile time.
constexpr std::array<std::array<ByteStep, 256>, 16> make_steps() {
  std::array<std::array<ByteStep, 256>, 16> steps{};
  for (int from = 0; from < 16; ++from) {
    for (int byte = 0; byte < 256; ++byte) {
      int last = from >> 3, run = from & 7, stuffed = 0;
      for (int i = 7; i >= 0; --i) {
        if (run == kRun) {
          ++stuffed;
          last = 1 - last;
          run = 1;
        }
        const int value = byte >> i & 1;
        run = value == last ? run + 1 : 1;
        last = value;
      }
      steps[static_cast<unsigned>(from)][static_cast<unsigned>(byte)] = {
          static_cast<std::uint8_t>(last << 3 | run), static_cast<std::uint8_t>(stuffed)};
    }
  }
  return steps;
}

constexpr auto kSteps = make_steps();

void Stuffing::byte(std::uint8_t value) {
  const ByteStep &step = kSteps[state & 15][value];
  count += step.stuffed;
  state = step.state;
}

struct Crc15 {
  std::uint32_t value = 0;
  void bits(std::uint32_t bits_in, int width) {
    for (int i = width - 1; i >= 0; --i) {
      const std::uint32_t next = (bits_in >> i & 1U) ^ (value >> 14 & 1U);
      value = (value << 1 & 0x7FFFU) ^ (next ? kCrc15Poly : 0U);
    }
  }
};

// Identifier with what lies around it, from start of frame; returns the number of bits.
template <class Sink>
int arbitration(const hoap2_can_frame_t &f, Sink &&sink) {
  const bool fd = f.flags & HOAP2_CAN_FD;
  const std::uint32_t remote = !fd && (f.flags & HOAP2_CAN_REMOTE) ? 1U : 0U;
  sink(0, 1);
  if (f.flags & HOAP2_CAN_EXTENDED) {
    sink(f.identifier >> 18 & 0x7FFU, 11);
    sink(3, 2);  // SRR, IDE
    sink(f.identifier & 0x3FFFFU, 18);
    sink(remote, 1);  // RTR, RRS
    return 33;
  }
  sink(f.identifier & 0x7FFU, 11);
  sink(remote, 1);
  sink(0, 1);  // IDE
  return 14;
}

FrameBits classic_bits(const hoap2_can_frame_t &f) {
  Stuffing stuffing;
  Crc15 crc;
  const auto sink = [&](std::uint32_t value, int width) {
    stuffing.bits(value, width);
    crc.bits(value, width);
  };
  int bits = arbitration(f, sink);
  const int reserved = f.flags & HOAP2_CAN_EXTENDED ? 2 : 1;
  sink(0, reserved);
  sink(f.length, 4);
  bits += reserved + 4;
  if (!(f.flags & HOAP2_CAN_REMOTE)) {
    for (int i = 0; i < f.length; ++i) sink(f.data[i], 8);
    bits += 8 * f.length;
  }
  stuffing.bits(crc.value, 15);
  // five equal bits at the very end of the CRC are followed by a stuff bit too
  const int last = (stuffing.state & 7) == kRun ? 1 : 0;
  return {bits + 15 + stuffing.count + last + 1 + kTail, 0};
}

FrameBits fd_bits(const hoap2_can_frame_t &f) {
  Stuffing stuffing;
  const auto sink = [&](std::uint32_t value, int width) { stuffing.bits(value, width); };
  int nominal = arbitration(f, sink);
  const std::uint32_t brs = f.flags & HOAP2_CAN_BRS ? 1U : 0U;
  sink(1, 1);  // FDF
  sink(0, 1);  // reserved
  sink(brs, 1);
  nominal += 3 + stuffing.count;
  const int before = stuffing.count;
  sink(0, 1);  // ESI: error active
  sink(static_cast<std::uint32_t>(length_code(f.length, true)), 4);
  for (int i = 0; i < f.length; ++i) stuffing.byte(f.data[i]);
  const int crc = f.length <= 16 ? 17 : 21;
  // one fixed stuff bit before the stuff count, then one behind every four bits
  const int fixed = 1 + (kStuffCountBits + crc) / 4;
  const int data = 5 + 8 * f.length + (stuffing.count - before) + kStuffCountBits + crc + fixed + 1;
  if (brs) return {nominal + kTail, data};
  return {nominal + data + kTail, 0};
}

}  // namespace

int length_code(int length, bool fd) {
  constexpr int kLong[] = {12, 16, 20, 24, 32, 48, 64};
  if (length >= 0 && length <= 8) return length;
  for (int i = 0; fd && i < 7; ++i) {
    if (kLong[i] == length) return 9 + i;
  }
  return -1;
}

FrameBits frame_bits(const hoap2_can_frame_t &frame) {
  return frame.flags & HOAP2_CAN_FD ? fd_bits(frame) : classic_bits(frame);
}

}  // namespace hoap2_sim
