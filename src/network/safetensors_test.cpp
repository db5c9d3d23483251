#include "linewright/network/safetensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

TensorFile sample() {
  TensorFile file;
  file.metadata = {{"line", "duct \"line\" \xc3\xa4"}, {"empty", ""}};
  file.tensors["b"] = {{2, 3}, {1.0F, -2.5F, 0.0F, -0.0F, 1e-40F, 3.4e38F}};
  file.tensors["a"] = {{}, {7.0F}};
  file.tensors["none"] = {{0, 5}, {}};
  return file;
}

std::string length_bytes(std::size_t length) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>((length >> (8 * i)) & 0xffU));
  return bytes;
}

std::string file_with(const std::string& header, std::size_t data_bytes) {
  return length_bytes(header.size()) + header + std::string(data_bytes, '\0');
}

std::string complaint(const std::string& bytes) {
  try {
    static_cast<void>(parse_safetensors(bytes, "t"));
    return "";
  } catch (const ScenarioError& error) {
    return error.diagnostics().front().message;
  }
}

TEST(Safetensors, ComeBackAsTheyWere) {
  EXPECT_EQ(parse_safetensors(to_safetensors(sample()), "t"), sample());
  EXPECT_EQ(parse_safetensors(to_safetensors({}), "t"), TensorFile());
}

TEST(Safetensors, AreTheSameBytesEachTime) {
  const std::string bytes = to_safetensors(sample());
  EXPECT_EQ(to_safetensors(parse_safetensors(bytes, "t")), bytes);
  const std::string header = R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})";
  EXPECT_EQ(to_safetensors({{}, {{"a", {{1}, {2.0F}}}}}), length_bytes(56) + header +
                                                              std::string(56 - header.size(), ' ') +
                                                              std::string("\0\0\0\x40", 4));
}

TEST(Safetensors, GoThroughAFile) {
  const std::string path = testing::TempDir() + "safetensors_test/a.safetensors";
  write_safetensors(path, sample());
  EXPECT_EQ(read_safetensors(path), sample());
  std::filesystem::remove_all(testing::TempDir() + "safetensors_test");
  EXPECT_THROW(static_cast<void>(read_safetensors(path)), ScenarioError);
}

TEST(Safetensors, CutOffAnywhereSayHowManyBytesAreMissing) {
  const std::string bytes = to_safetensors(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(complaint(bytes.substr(0, size)), "");
  }
  EXPECT_EQ(complaint(bytes.substr(0, bytes.size() - 3)),
            "the file is cut off: 3 bytes are missing");
  EXPECT_EQ(complaint(bytes.substr(0, 3)), "the file is cut off: 5 bytes are missing");
  EXPECT_EQ(complaint(length_bytes(10) + "{}"), "the file is cut off: 8 bytes are missing");
}

TEST(Safetensors, RefuseWhatFollowsTheLastTensor) {
  EXPECT_EQ(complaint(to_safetensors(sample()) + "x"), "1 bytes stand behind the last tensor");
}

TEST(Safetensors, RefuseHeadersThatAreNoHeaders) {
  EXPECT_EQ(complaint(length_bytes(~std::size_t{0})),
            "its header would be 18446744073709551615 bytes long: this is no safetensors file");
  EXPECT_EQ(complaint(file_with(" {}", 0)), "its header is not JSON: this is no safetensors file");
  EXPECT_EQ(complaint(file_with("", 0)), "its header is not JSON: this is no safetensors file");
  EXPECT_EQ(complaint(file_with("{", 0)), "the header is not valid JSON (byte 2)");
  EXPECT_EQ(complaint(file_with(R"({"a":[[[[1]]]]})", 0)), "the header is nested too deeply");
  EXPECT_EQ(complaint(file_with("{\"\xff\":1}", 0)), "the header is not valid JSON (byte 3)");
}

/// A header of one tensor 'a' with these members.
std::string one(const std::string& members, std::size_t data_bytes = 4) {
  return complaint(file_with("{\"a\":{" + members + "}}", data_bytes));
}

TEST(Safetensors, RefuseEntriesThatAreNotOfTheFormat) {
  const std::string type = R"("dtype":"F32",)";
  EXPECT_EQ(one(type + R"("shape":[1],"data_offsets":[0,4])"), "");
  EXPECT_EQ(one(R"("dtype":"BF16","shape":[2],"data_offsets":[0,4])"),
            "the tensor 'a' is of type 'BF16'; only F32 can be read");
  EXPECT_EQ(one(R"("dtype":1,"shape":[1],"data_offsets":[0,4])"),
            "the tensor 'a' has 'dtype': it must be text, not '1'");
  EXPECT_EQ(one(type + R"("shape":[1])"), "the tensor 'a' lacks the key 'data_offsets'");
  EXPECT_EQ(one(type + R"("shape":[1],"data_offsets":[0,4],"more":1)"),
            "the tensor 'a' has the unknown key 'more'");
  EXPECT_EQ(one(type + R"("shape":[-1],"data_offsets":[0,4])"),
            "the tensor 'a' has 'shape': it must hold whole numbers from 0 on");
  EXPECT_EQ(one(type + R"("shape":[1.0],"data_offsets":[0,4])"),
            "the tensor 'a' has 'shape': it must hold whole numbers from 0 on");
  EXPECT_EQ(one(type + R"("shape":[1],"data_offsets":[0,4,8])"),
            "the tensor 'a' needs two 'data_offsets'");
  EXPECT_EQ(one(type + R"("shape":[1],"data_offsets":[4,0])"),
            "the tensor 'a' has the shape [1], which does not fit its bytes 4 to 0");
  EXPECT_EQ(one(type + R"("shape":[2],"data_offsets":[0,4])"),
            "the tensor 'a' has the shape [2], which does not fit its bytes 0 to 4");
  EXPECT_EQ(one(type + R"("shape":[4611686018427387905,4],"data_offsets":[0,4])"),
            "the tensor 'a' has the shape [4611686018427387905, 4], which does not fit its bytes "
            "0 to 4");
  EXPECT_EQ(complaint(file_with(R"({"a":1})", 0)),
            "the tensor 'a' must be a JSON object, not number");
}

TEST(Safetensors, RefuseKeysGivenTwice) {
  const std::string a = R"("a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]})";
  EXPECT_EQ(complaint(file_with("{" + a + "," + a + "}", 4)), "the header has the key 'a' twice");
  EXPECT_EQ(one(R"("dtype":"F32","shape":[1],"shape":[1],"data_offsets":[0,4])"),
            "the header has the key 'shape' twice");
  EXPECT_EQ(complaint(file_with(R"({"__metadata__":{"a":"b"},"__metadata__":{"a":"b"}})", 0)),
            "the header has the key '__metadata__' twice");
}

std::string two(int a_begin, int a_end, int b_begin, int b_end) {
  const auto entry = [](int begin, int end) {
    return R"({"dtype":"F32","shape":[)" + std::to_string((end - begin) / 4) +
           R"(],"data_offsets":[)" + std::to_string(begin) + "," + std::to_string(end) + "]}";
  };
  return complaint(
      file_with("{\"a\":" + entry(a_begin, a_end) + ",\"b\":" + entry(b_begin, b_end) + "}", 16));
}

TEST(Safetensors, RefuseTensorsThatOverlapOrLeaveGaps) {
  EXPECT_EQ(two(0, 8, 8, 16), "");
  EXPECT_EQ(two(8, 16, 0, 8), "");
  EXPECT_EQ(two(0, 8, 4, 16), "the tensor 'b' overlaps another");
  EXPECT_EQ(two(0, 16, 0, 16), "the tensor 'b' overlaps another");
  EXPECT_EQ(two(0, 4, 8, 16), "the tensor 'b' stands behind a gap");
  EXPECT_EQ(two(4, 8, 8, 16), "the tensor 'a' stands behind a gap");
}

TEST(Safetensors, RefuseMetadataOtherThanText) {
  EXPECT_EQ(complaint(file_with(R"({"__metadata__":{"a":1}})", 0)),
            "the metadata has 'a': it must be text");
  EXPECT_EQ(complaint(file_with(R"({"__metadata__":[]})", 0)),
            "the metadata must be a JSON object, not array");
}

TEST(Safetensors, RefuseNumbersThatAreNotFinite) {
  std::string bytes = to_safetensors({{}, {{"a", {{2}, {2.0F, 1.0F}}}}});
  bytes[bytes.size() - 1] = '\x7f';  // 1.0F is 0x3f800000
  EXPECT_EQ(complaint(bytes), "the tensor 'a' holds a number that is not finite (number 2)");
}

TEST(Safetensors, AreNotWrittenWhenTheyCouldNotBeRead) {
  const auto refused = [](const std::string& name, const Tensor& tensor) {
    EXPECT_THROW(static_cast<void>(to_safetensors({{}, {{name, tensor}}})), ScenarioError);
  };
  refused("a", {{2}, {1.0F}});
  refused("a", {{-1}, {1.0F}});
  refused("a", {{1}, {NAN}});
  refused("a", {{1}, {INFINITY}});
  refused("__metadata__", {{1}, {1.0F}});
  refused("\xff", {{1}, {1.0F}});
  EXPECT_THROW(static_cast<void>(to_safetensors({{{"a", "\xff"}}, {}})), ScenarioError);
}

}  // namespace
}  // namespace linewright
