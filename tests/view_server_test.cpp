// `linewright view` as a server: what it answers, whom it refuses, and who cannot block it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "linewright/base/random.hpp"
#include "tests/view_support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kLog = LINEWRIGHT_SOURCE_DIR "/tests/golden/kitting_cell-first.jsonl";

std::string status_of(const std::string& answer) { return answer.substr(0, answer.find("\r\n")); }

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class ViewServer : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_NE(tool_.port(), 0) << tool_.output(); }

  /// The answer to exactly these bytes.
  [[nodiscard]] std::string talk(const std::string& bytes) const {
    const Client client(port());
    client.send(bytes);
    return client.receive();
  }

  [[nodiscard]] std::string ask(const std::string& first, const std::string& headers) const {
    return talk(fmt::format("{} HTTP/1.1\r\n{}Connection: close\r\n\r\n", first, headers));
  }

  [[nodiscard]] std::string host() const { return fmt::format("Host: 127.0.0.1:{}\r\n", port()); }
  [[nodiscard]] std::uint16_t port() const { return tool_.port(); }

  PageFolder folder_;
  RunningTool tool_{folder_.path(), {"view", kLog, "--no-open"}};
};

TEST_F(ViewServer, ServesThePageTheListAndTheLog) {
  const std::string page = get(port(), "/");
  EXPECT_EQ(status_of(page), "HTTP/1.1 200 OK");
  EXPECT_EQ(body_of(page), kPage);
  EXPECT_EQ(body_of(get(port(), "/?t=100")), kPage);
  const auto list = nlohmann::json::parse(body_of(get(port(), "/logs.json")));
  EXPECT_EQ(list,
            nlohmann::json::parse(
                R"({"logs":[{"name":"kitting_cell-first.jsonl","href":"logs/0","live":false}]})"));
  const std::string log = get(port(), "/logs/0");
  EXPECT_TRUE(has(log, "Transfer-Encoding: chunked"));
  EXPECT_EQ(body_of(log), read_file(kLog));
}

TEST_F(ViewServer, EveryAnswerSaysThatItIsNotToBeKeptGuessedOrFramed) {
  for (const char* path : {"/", "/logs.json", "/logs/0", "/nothing"}) {
    const std::string answer = get(port(), path);
    EXPECT_TRUE(has(answer, "Cache-Control: no-store\r\n")) << path;
    EXPECT_TRUE(has(answer, "X-Content-Type-Options: nosniff\r\n")) << path;
    EXPECT_TRUE(has(answer, "Content-Security-Policy: default-src 'none';")) << path;
    EXPECT_TRUE(has(answer, "frame-ancestors 'none'")) << path;
  }
}

TEST_F(ViewServer, AnswersOneRequestAfterTheOtherOnOneConnection) {
  const Client client(port());
  for (int i = 0; i < 3; ++i) {
    client.send(fmt::format("GET /logs.json HTTP/1.1\r\n{}\r\n", host()));
    EXPECT_EQ(status_of(client.receive_some(5000)), "HTTP/1.1 200 OK");
  }
}

TEST_F(ViewServer, HeadHasTheHeadersAlone) {
  const std::string page = ask("HEAD /", host());
  EXPECT_EQ(status_of(page), "HTTP/1.1 200 OK");
  EXPECT_TRUE(has(page, fmt::format("Content-Length: {}\r\n", std::string(kPage).size())));
  EXPECT_EQ(body_of(page), "");
  const std::string log = ask("HEAD /logs/0", host());
  EXPECT_EQ(status_of(log), "HTTP/1.1 200 OK");
  EXPECT_TRUE(log.ends_with("\r\n\r\n"));
}

TEST_F(ViewServer, ServesOldClientsWithoutPieces) {
  const std::string log = talk(fmt::format("GET /logs/0 HTTP/1.0\r\n{}\r\n", host()));
  EXPECT_FALSE(has(log, "chunked"));
  EXPECT_EQ(body_of(log), read_file(kLog));
}

TEST_F(ViewServer, RefusesForeignHosts) {
  EXPECT_EQ(status_of(ask("GET /", fmt::format("Host: localhost:{}\r\n", port()))),
            "HTTP/1.1 200 OK");
  for (const std::string& host :
       {std::string("evil.example"), fmt::format("evil.example:{}", port()),
        std::string("127.0.0.1"), std::string("127.0.0.1:1"),
        fmt::format("127.0.0.1:{}.evil.example", port()), std::string()}) {
    for (const char* path : {"/", "/logs.json", "/logs/0"}) {
      const std::string answer = ask(fmt::format("GET {}", path), "Host: " + host + "\r\n");
      EXPECT_EQ(status_of(answer), "HTTP/1.1 403 Forbidden") << host << path;
      EXPECT_FALSE(has(answer, "event_log")) << host << path;
    }
  }
  EXPECT_EQ(status_of(ask("GET /logs/0", "")), "HTTP/1.1 403 Forbidden");
}

TEST_F(ViewServer, RefusesForeignOrigins) {
  const auto from = [&](const std::string& origin) {
    return status_of(ask("GET /logs/0", host() + "Origin: " + origin + "\r\n"));
  };
  EXPECT_EQ(from(fmt::format("http://127.0.0.1:{}", port())), "HTTP/1.1 200 OK");
  EXPECT_EQ(from(fmt::format("http://localhost:{}", port())), "HTTP/1.1 200 OK");
  for (const std::string& origin :
       {std::string("http://evil.example"), std::string("null"), std::string("http://127.0.0.1"),
        fmt::format("https://127.0.0.1:{}", port()), fmt::format("127.0.0.1:{}", port())}) {
    EXPECT_EQ(from(origin), "HTTP/1.1 403 Forbidden") << origin;
  }
}

TEST_F(ViewServer, HasNothingElse) {
  for (const char* path : {"/logs/1", "/logs/", "/logs/-1", "/logs/00", "/logs/0/", "/logs/0x0",
                           "/index.html", "/../etc/passwd", "/%2e%2e/etc/passwd", "//",
                           "/logs/99999999999999999999", "/web/linewright-view.html"}) {
    EXPECT_EQ(status_of(get(port(), path)), "HTTP/1.1 404 Not Found") << path;
  }
}

TEST_F(ViewServer, OnlyReads) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE"}) {
    const std::string answer = ask(fmt::format("{} /", method), host());
    EXPECT_EQ(status_of(answer), "HTTP/1.1 405 Method Not Allowed") << method;
    EXPECT_TRUE(has(answer, "Allow: GET, HEAD\r\n")) << method;
  }
  const std::string body = ask("POST /logs.json", host() + "Content-Length: 1000000\r\n");
  EXPECT_EQ(status_of(body), "HTTP/1.1 413 Payload Too Large");
}

TEST_F(ViewServer, SurvivesWhatIsNoRequest) {
  RandomStream random(7);
  std::string noise;
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>(random.below(256));
  const std::vector<std::string> garbage = {
      noise,
      "\r\n\r\n",
      "GET\r\n\r\n",
      "GET / HTTP/9.9\r\n\r\n",
      "GET / HTTP/1.1\r\nHost 127.0.0.1\r\n\r\n",
      std::string(1'000'000, 'A'),
      "GET /" + std::string(1'000'000, 'a') + " HTTP/1.1\r\n\r\n",
      "GET / HTTP/1.1\r\nX: " + std::string(1'000'000, 'x') + "\r\n\r\n",
      "GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n",
      "GET / HTTP/1.1\r\nContent-Length: 99999999999999999999999\r\n\r\n",
      std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11)};  // TLS
  for (const std::string& bytes : garbage) {
    const Client client(port());
    client.send(bytes);
    client.end_sending();
    const std::string answer = client.receive();
    EXPECT_FALSE(answer.starts_with("HTTP/1.1 2")) << bytes.substr(0, 40);
  }
  EXPECT_EQ(status_of(get(port(), "/")), "HTTP/1.1 200 OK");
}

TEST_F(ViewServer, RefusesHeadersThatAreTooLong) {
  const std::string answer = ask("GET /", host() + "X: " + std::string(9000, 'x') + "\r\n");
  EXPECT_EQ(status_of(answer), "HTTP/1.1 431 Request Header Fields Too Large");
}

TEST_F(ViewServer, CutsOffWhoDoesNotSendItsRequest) {
  const auto begun = Clock::now();
  const Client slow(port());
  slow.send("GET / HTTP/1.1\r\n");
  while (Clock::now() - begun < std::chrono::seconds(15) && slow.send("X: 1\r\n")) {
    EXPECT_EQ(status_of(get(port(), "/logs.json")), "HTTP/1.1 200 OK");  // others are served
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_LT(Clock::now() - begun, std::chrono::seconds(12));
}

TEST_F(ViewServer, ServesNewClientsWhileHundredsOfOthersSayNothing) {
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < 400; ++i) {
    silent.push_back(std::make_unique<Client>(port()));
    ASSERT_TRUE(silent.back()->connected());
    if (i % 100 == 99) {
      EXPECT_EQ(status_of(get(port(), "/")), "HTTP/1.1 200 OK") << i;
    }
  }
}

TEST_F(ViewServer, ServesManyAtOnce) {
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 100; ++i) clients.push_back(std::make_unique<Client>(port()));
  for (const auto& client : clients) {
    client->send(fmt::format("GET /logs/0 HTTP/1.1\r\n{}Connection: close\r\n\r\n", host()));
  }
  const std::string log = read_file(kLog);
  for (const auto& client : clients) EXPECT_EQ(body_of(client->receive()), log);
}

TEST_F(ViewServer, ClientsThatGoAwayInTheMiddleDoNoHarm) {
  for (int i = 0; i < 100; ++i) {
    const Client client(port());
    client.send(fmt::format("GET /logs/0 HTTP/1.1\r\n{}\r\n", host()));
  }
  EXPECT_EQ(status_of(get(port(), "/")), "HTTP/1.1 200 OK");
}

TEST_F(ViewServer, EndsWithCtrlC) {
  const Client open(port());  // somebody is still there
  tool_.signal(SIGINT);
  EXPECT_EQ(tool_.wait(), 130);
  EXPECT_FALSE(Client(port()).connected());
}

TEST(ViewPort, IsTheOneThatWasAskedForAndNoOther) {
  const PageFolder folder;
  std::uint16_t port = 0;
  {
    const RunningTool first(folder.path(), {"view", kLog, "--no-open"});
    port = first.port();
    ASSERT_NE(port, 0);
    RunningTool second(folder.path(), {"view", kLog, "--no-open", "--port", std::to_string(port)});
    EXPECT_EQ(second.port(), 0);
    EXPECT_EQ(second.wait(), 2);
    EXPECT_TRUE(has(second.output(), "cannot be used")) << second.output();
  }
  const RunningTool again(folder.path(),
                          {"view", kLog, "--no-open", "--port", std::to_string(port)});
  EXPECT_EQ(again.port(), port);
}

TEST(ViewWatch, SendsTheRunAsItHappensAndEndsWithIt) {
  const PageFolder folder;
  const std::string log = folder.file("run.jsonl");
  RunningTool tool(
      folder.path(),
      {"simulate", LINEWRIGHT_SOURCE_DIR "/scenarios/teaching/one_human_one_robot.yaml", "--watch",
       "--watch-speed", "60", "--no-open", "--log", log});
  ASSERT_NE(tool.port(), 0) << tool.output();
  EXPECT_TRUE(has(body_of(get(tool.port(), "/logs.json")), "\"live\":true"));
  const Client client(tool.port());
  client.send(fmt::format("GET /logs/0 HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                          tool.port()));
  std::string answer = client.receive_some(5000);
  while (!has(answer, "\"decision\"")) answer += client.receive_some(5000);
  EXPECT_FALSE(has(answer, "\"end\""));
  EXPECT_FALSE(std::filesystem::exists(log));  // the run goes on
  answer += client.receive(60'000);
  EXPECT_EQ(tool.wait(), 0);
  EXPECT_EQ(body_of(answer), read_file(log));
  EXPECT_TRUE(has(tool.output(), "makespan")) << tool.output();
}

TEST(ViewWatch, EndsWithCtrlC) {
  const PageFolder folder;
  RunningTool tool(folder.path(), {"simulate", LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml",
                                   "--watch", "--watch-speed", "1", "--no-open"});
  ASSERT_NE(tool.port(), 0) << tool.output();
  tool.signal(SIGINT);
  EXPECT_EQ(tool.wait(), 130);
}

}  // namespace
}  // namespace linewright::testing

#endif
