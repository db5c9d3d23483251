#include "linewright/training/tensorboard.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "crc32c.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

std::string temporary(const std::string& name) {
  return testing::TempDir() + "linewright_tensorboard_" +
         testing::UnitTest::GetInstance()->current_test_info()->name() + "/" + name;
}

/// The checksum bit by bit, as the standard defines it.
std::uint32_t plain_crc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0x82f63b78 : crc >> 1;
  }
  return ~crc;
}

/// A reader of its own for what the writer writes.
class Bytes {
 public:
  explicit Bytes(std::string_view rest) : rest_(rest) {}
  [[nodiscard]] bool done() const { return rest_.empty(); }
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throw std::runtime_error("cut off");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::uint64_t fixed(std::size_t count) {
    std::uint64_t value = 0;
    const std::string_view bytes = take(count);
    for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1)[0]);
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw std::runtime_error("varint too long");
  }

 private:
  std::string_view rest_;
};

struct Event {
  double wall_time_s = 0.0;
  std::int64_t step = 0;
  std::string file_version;
  std::string tag;
  float value = 0.0F;
};

void read_value(std::string_view bytes, Event& event) {
  Bytes fields(bytes);
  while (!fields.done()) {
    const std::uint64_t key = fields.varint();
    if (key == (1 << 3 | 2)) {
      event.tag = fields.take(fields.varint());
    } else if (key == (2 << 3 | 5)) {
      event.value = std::bit_cast<float>(static_cast<std::uint32_t>(fields.fixed(4)));
    } else {
      throw std::runtime_error("unknown field of Summary.Value");
    }
  }
}

Event read_event(std::string_view bytes) {
  Event event;
  Bytes fields(bytes);
  while (!fields.done()) {
    const std::uint64_t key = fields.varint();
    if (key == (1 << 3 | 1)) {
      event.wall_time_s = std::bit_cast<double>(fields.fixed(8));
    } else if (key == (2 << 3 | 0)) {
      event.step = static_cast<std::int64_t>(fields.varint());
    } else if (key == (3 << 3 | 2)) {
      event.file_version = fields.take(fields.varint());
    } else if (key == (5 << 3 | 2)) {
      Bytes summary(fields.take(fields.varint()));
      if (summary.varint() != (1 << 3 | 2)) throw std::runtime_error("unknown field of Summary");
      read_value(summary.take(summary.varint()), event);
    } else {
      throw std::runtime_error("unknown field of Event");
    }
  }
  return event;
}

std::vector<Event> read_events(const std::string& path) {
  std::string reason;
  const std::string content = read_file(path, 1 << 20, reason).value();
  const auto check = [](std::string_view bytes, std::uint64_t masked) {
    const auto rotated = static_cast<std::uint32_t>(masked) - 0xa282ead8U;
    if ((rotated >> 17 | rotated << 15) != plain_crc(bytes)) throw std::runtime_error("wrong CRC");
  };
  std::vector<Event> events;
  Bytes records(content);
  while (!records.done()) {
    const std::string_view header = records.take(8);
    check(header, records.fixed(4));
    const std::string_view event = records.take(Bytes(header).fixed(8));
    check(event, records.fixed(4));
    events.push_back(read_event(event));
  }
  return events;
}

TEST(Crc32c, GivesThePublishedValues) {
  EXPECT_EQ(crc32c("123456789"), 0xe3069283U);
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8a9136aaU);
  EXPECT_EQ(crc32c(std::string(32, '\xff')), 0x62a8ab43U);
  EXPECT_EQ(crc32c(""), 0U);
}

TEST(TensorBoardLog, WritesEventsThatReadBack) {
  const std::string path = temporary("events.out.tfevents.1");
  TensorBoardLog log = TensorBoardLog::create(path, 1.5);
  log.scalar("train/loss", 0, 0.25F, 2.5);
  log.scalar(std::string(300, 'x'), 123'456'789'012, -1e-30F, 1.7e9);
  log.scalar("nan", 7, std::nanf(""), 3.0);
  log.flush();
  const std::vector<Event> events = read_events(path);
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[0].file_version, "brain.Event:2");
  EXPECT_EQ(events[0].wall_time_s, 1.5);
  EXPECT_EQ(events[1].tag, "train/loss");
  EXPECT_EQ(events[1].step, 0);
  EXPECT_EQ(events[1].value, 0.25F);
  EXPECT_EQ(events[1].wall_time_s, 2.5);
  EXPECT_EQ(events[2].tag, std::string(300, 'x'));
  EXPECT_EQ(events[2].step, 123'456'789'012);
  EXPECT_EQ(events[2].value, -1e-30F);
  EXPECT_EQ(events[2].wall_time_s, 1.7e9);
  EXPECT_TRUE(std::isnan(events[3].value));
}

TEST(TensorBoardLog, AResumedRunLosesWhatCameAfterItsCheckpoint) {
  const std::string path = temporary("events.out.tfevents.1");
  std::uint64_t size = 0;
  {
    TensorBoardLog log = TensorBoardLog::create(path, 1.0);
    log.scalar("a", 1, 1.0F, 1.0);
    log.flush();
    size = log.size();
    log.scalar("a", 2, 2.0F, 1.0);
    log.flush();
  }
  TensorBoardLog log = TensorBoardLog::reopen(path, size);
  EXPECT_EQ(log.size(), size);
  log.scalar("a", 2, 3.0F, 2.0);
  log.flush();
  const std::vector<Event> events = read_events(path);
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[1].value, 1.0F);
  EXPECT_EQ(events[2].value, 3.0F);
}

TEST(TensorBoardLog, FailuresNameTheFile) {
  try {
    static_cast<void>(TensorBoardLog::create("/dev/full", 0.0));
    FAIL() << "a full device was written to";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/full"), std::string::npos);
  }
  EXPECT_THROW(static_cast<void>(TensorBoardLog::reopen(temporary("none"), 0)), ScenarioError);
}

}  // namespace
}  // namespace linewright
