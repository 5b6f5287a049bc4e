#include "view/server/view_server.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "tests/unit/view/server/raw_client.h"
#include "tests/unit/view/server/small_result.h"

namespace view::server::test {
namespace {

constexpr const char* kSecret = "the-secret-beside-the-folder";

class RecordedCommands final : public RunControl {
 public:
  hal::Result<std::int64_t> act(const Command& command) override {
    const std::lock_guard lock(mutex_);
    commands.push_back(command);
    if (std::holds_alternative<DriveByHand>(command)) {
      return hal::fail(hal::Errc::kNotAvailable, "nobody drives it by hand");
    }
    return std::holds_alternative<Break>(command) ? 7 : 0;
  }

  std::vector<Command> commands;

 private:
  std::mutex mutex_;
};

struct StoppedClock final : Clock {
  Now now() const override { return {.now = 5, .until = 4, .paused = true, .stopped_by = "r0"}; }
  void keep() const override { ++kept; }
  mutable std::atomic<int> kept = 0;
};

class ViewServerTest : public testing::Test {
 protected:
  ViewServerTest() : result(testing::UnitTest::GetInstance()->current_test_info()->name()) {
    result.recorder->on_state(Time{1s}, AgentId{1}, "IDLE");
    result.end(2'000'000'000);
    std::ofstream(result.path() / "private.txt") << kSecret;
  }

  ViewServer& start(RunControl* with = nullptr) {
    ViewServer::Settings settings;
    settings.page = "<html><script>the page</script></html>";
    settings.runs.push_back(std::make_unique<server::Run>(result.path()));
    settings.control = with;
    settings.clock = with != nullptr ? &clock : nullptr;
    if (with != nullptr) settings.mode = ViewApi::Mode::kLive;
    server.emplace(std::move(settings));
    EXPECT_TRUE(server->start());
    return *server;
  }

  /// With the token, if there is one.
  std::string get(const std::string& path) const { return get(path, token_header()); }

  std::string get(const std::string& path, const std::string& headers) const {
    return answer_to(server->port(), fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n",
                                                 path, server->port(), headers));
  }

  std::string post(const std::string& body, const std::string& headers) const {
    return answer_to(server->port(),
                     fmt::format("POST /api/control HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}"
                                 "Content-Length: {}\r\n\r\n{}",
                                 server->port(), headers, body.size(), body));
  }

  std::string token_header() const {
    const std::string address = server->address();
    if (address.find('#') == std::string::npos) return "";
    return "X-Baraka-Token: " + address.substr(address.find('=') + 1) + "\r\n";
  }

  static int status_of(const std::string& answer) {
    return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9)) : 0;
  }

  SmallResult result;
  RecordedCommands control;
  StoppedClock clock;
  std::optional<ViewServer> server;
};

TEST_F(ViewServerTest, ServesThePageAndTheApi) {
  start();
  const std::string page = get("/");
  EXPECT_EQ(status_of(page), 200);
  EXPECT_TRUE(page.ends_with("<html><script>the page</script></html>"));
  for (const char* header : {"X-Content-Type-Options: nosniff", "Content-Security-Policy: default",
                             "Cache-Control: no-store", "Connection: close"}) {
    EXPECT_NE(page.find(header), std::string::npos) << header;
  }
  EXPECT_NE(get("/api/view").find(R"("can_command":false)"), std::string::npos);
  EXPECT_NE(get("/api/runs/0/states/14/0").find("IDLE"), std::string::npos);
  EXPECT_EQ(status_of(get("/api/runs/1/world")), 404);
  EXPECT_EQ(status_of(get("/api/clock")), 404);
}

TEST_F(ViewServerTest, RefusesWhatComesFromElsewhere) {
  start(&control);
  const int port = server->port();
  const auto ask = [&](const std::string& head) {
    return status_of(answer_to(port, head + "\r\n"));
  };
  const std::string own = fmt::format("Host: 127.0.0.1:{}\r\n", port);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\nHost: evil.example\r\n"), 421);
  EXPECT_EQ(ask("GET / HTTP/1.1\r\nHost: evil.example\r\n"), 421);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n"), 421);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n" + own + own), 421);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n" + own + "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n" + own + "Sec-Fetch-Site: cross-site\r\n"), 403);
  EXPECT_EQ(ask("DELETE /api/view HTTP/1.1\r\n" + own), 405);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n" + own), 403);
  EXPECT_EQ(ask("GET /api/view HTTP/1.1\r\n" + own + token_header()), 200);
}

TEST_F(ViewServerTest, ALiveRunIsReadWithTheTokenOnly) {
  start(&control);
  EXPECT_EQ(status_of(get("/", "")), 200);  // says nothing of the run
  for (const char* path :
       {"/api/view", "/api/clock", "/api/runs/0/world", "/api/runs/0/states/14/0"}) {
    EXPECT_EQ(status_of(get(path, "")), 403) << path;
    EXPECT_EQ(status_of(get(path, "X-Baraka-Token: 0\r\n")), 403) << path;
    EXPECT_EQ(status_of(get(path)), 200) << path;
  }
}

TEST_F(ViewServerTest, TakesCommandsWithTheTokenOnly) {
  start(&control);
  const std::string pause = R"({"command":"pause"})";
  EXPECT_EQ(status_of(post(pause, "")), 403);
  EXPECT_EQ(status_of(post(pause, "X-Baraka-Token: 0\r\n")), 403);
  EXPECT_EQ(status_of(post(pause, token_header() + "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(status_of(post(pause, token_header() + "Host: evil.example\r\n")), 421);
  EXPECT_TRUE(control.commands.empty());
  EXPECT_EQ(status_of(post(pause, token_header())), 200);
  ASSERT_EQ(control.commands.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Pause>(control.commands.front()));
  const std::string made = post(R"({"command":"break","on":"loss"})", token_header());
  EXPECT_TRUE(made.ends_with(R"({"id":7})")) << made;
}

TEST_F(ViewServerTest, SaysWhyACommandWasNotTaken) {
  start(&control);
  const std::string unknown = post(R"({"command":"halt"})", token_header());
  EXPECT_EQ(status_of(unknown), 400);
  EXPECT_NE(unknown.find("is not one of"), std::string::npos);
  const std::string drive =
      post(R"({"command":"drive","agent":3,"vx":1,"omega":0})", token_header());
  EXPECT_EQ(status_of(drive), 409);
  EXPECT_NE(drive.find("nobody drives it by hand"), std::string::npos);
  EXPECT_EQ(status_of(post(std::string(100'000, ' '), token_header())), 413);
  EXPECT_EQ(control.commands.size(), 1U);
}

TEST_F(ViewServerTest, WithoutControlNothingCanBeCommanded) {
  start();
  EXPECT_EQ(server->address().find('#'), std::string::npos);
  EXPECT_EQ(status_of(post(R"({"command":"pause"})", "X-Baraka-Token: \r\n")), 403);
}

TEST_F(ViewServerTest, TheClockOfALiveRunIsToldAtOnce) {
  start(&control);
  EXPECT_NE(get("/api/clock").find(R"({"now":5,"until":4,"can_hold":true,"paused":true)"),
            std::string::npos);
}

TEST_F(ViewServerTest, APageSaysThatItIsOpen) {
  start(&control);
  EXPECT_EQ(status_of(get("/api/open")), 200);
  EXPECT_EQ(clock.kept, 1);
  EXPECT_EQ(status_of(get("/api/open", "")), 403);  // without the token
  EXPECT_EQ(clock.kept, 1);
}

TEST_F(ViewServerTest, ManyTabsAtOnceAreAllAnsweredSoon) {
  start(&control);
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> tabs;
  std::atomic<int> answered = 0;
  for (int i = 0; i < 40; ++i) {
    tabs.emplace_back([&] {
      for (int n = 0; n < 5; ++n) answered += status_of(get("/api/clock")) == 200 ? 1 : 0;
    });
  }
  for (std::thread& tab : tabs) tab.join();
  EXPECT_EQ(answered, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);  // nobody was turned away
}

// Browsers open connections that they may need.
TEST_F(ViewServerTest, IdleConnectionsDoNotKeepOthersOut) {
  start();
  std::vector<int> idle;
  for (int i = 0; i < 40; ++i) idle.push_back(connected(server->port()));
  EXPECT_EQ(status_of(get("/api/view")), 200);
  for (const int socket : idle) ::close(socket);
}

/// Connections over which a request comes a byte at a time, and is never whole.
class Trickle {
 public:
  Trickle(int port, int count) {
    for (int i = 0; i < count; ++i) sockets_.push_back(connected(port));
    for (const int socket : sockets_) send(socket, "GET /api/view HTTP/1.1\r\nX-Slow: ");
    thread_ = std::thread([this] {
      while (!is_over_) {
        for (const int socket : sockets_) send(socket, "a");
        std::this_thread::sleep_for(50ms);
      }
    });
  }
  ~Trickle() {
    is_over_ = true;
    thread_.join();
    for (const int socket : sockets_) ::close(socket);
  }
  Trickle(const Trickle&) = delete;
  Trickle& operator=(const Trickle&) = delete;

  /// How many the other side has closed.
  int closed() const {
    int count = 0;
    for (const int socket : sockets_) {
      char answer[4096];
      ssize_t size = 0;
      do {
        size = ::recv(socket, answer, sizeof answer, MSG_DONTWAIT);
      } while (size > 0);
      count += size == 0 || (size < 0 && errno != EAGAIN) ? 1 : 0;
    }
    return count;
  }

 private:
  static void send(int socket, std::string_view bytes) {
    (void)::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  std::vector<int> sockets_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

TEST_F(ViewServerTest, ARequestThatTricklesInIsCutAtItsDeadline) {
  start();
  const Trickle slow(server->port(), 1);
  std::this_thread::sleep_for(1s);
  EXPECT_EQ(slow.closed(), 0);
  std::this_thread::sleep_for(2s);
  EXPECT_EQ(slow.closed(), 1);
}

TEST_F(ViewServerTest, ManySlowClientsDoNotKeepOthersOut) {
  start();
  const Trickle slow(server->port(), 200);
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(status_of(get("/api/view")), 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s) << "waited for their deadlines";
  }
}

TEST_F(ViewServerTest, SlowClientsDoNotKeepItFromEnding) {
  start();
  const Trickle slow(server->port(), 20);
  std::this_thread::sleep_for(200ms);
  const auto begin = std::chrono::steady_clock::now();
  server->stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s) << "waited for their deadlines";
}

TEST_F(ViewServerTest, HeadsWithoutEndAreCutByTheirBytes) {
  start();
  std::string head = fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", server->port());
  for (int i = 0; i < 10'000; ++i) head += fmt::format("X-{}: {}\r\n", i, i);
  EXPECT_NE(status_of(answer_to(server->port(), head + "\r\n")), 200);
  EXPECT_EQ(status_of(get("/")), 200);
}

TEST_F(ViewServerTest, ABodyOfUnknownLengthIsNotRead) {
  start(&control);
  const std::string head = fmt::format("POST /api/control HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}",
                                       server->port(), token_header());
  const std::string body = "13\r\n{\"command\":\"pause\"}\r\n0\r\n\r\n";
  for (const char* header :
       {"Transfer-Encoding: chunked\r\n", "Content-Encoding: gzip\r\nContent-Length: 33\r\n"}) {
    EXPECT_EQ(status_of(answer_to(server->port(), head + header + "\r\n" + body)), 411) << header;
  }
  EXPECT_TRUE(control.commands.empty());
}

TEST_F(ViewServerTest, APortThatIsTakenIsNamed) {
  const ViewServer& first = start();
  ViewServer::Settings settings;
  settings.port = first.port();
  settings.runs.push_back(std::make_unique<server::Run>(result.path()));
  ViewServer second(std::move(settings));
  const hal::Result<void> started = second.start();
  ASSERT_FALSE(started) << "two servers share a port";
  EXPECT_NE(started.error().message.find(std::to_string(first.port())), std::string::npos);
}

TEST_F(ViewServerTest, StopsInASecondOrTwoWhoeverIsConnected) {
  start();
  const auto begin = std::chrono::steady_clock::now();
  server->stop();
  server->stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);
  EXPECT_EQ(answer_to(server->port(), "GET / HTTP/1.1\r\n\r\n"), "");
}

TEST_F(ViewServerTest, NoFileIsServedByItsName) {
  start();
  for (const char* path :
       {"/private.txt", "/run.sqlite", "/../private.txt", "/api/runs/0/private.txt",
        "/api/runs/0/../../private.txt", "/api/runs/0/%2e%2e/private.txt", "//etc/passwd",
        "/api/runs/0/poses/14/..%2f..%2fprivate.txt", "/%00", "/api/runs/0/run.log"}) {
    const std::string answer = get(path);
    EXPECT_EQ(status_of(answer), 404) << path;
    EXPECT_EQ(answer.find(kSecret), std::string::npos) << path;
  }
}

/// Requests that are nearly right: what a request has, in wrong places, cut, doubled or with other
/// bytes.
class Mutations {
 public:
  Mutations(int port, const std::string& token) : own_(fmt::format("127.0.0.1:{}", port)) {
    seeds_ = {request("GET", "/", ""),
              request("GET", "/api/view", ""),
              request("GET", "/api/runs/0/world", ""),
              request("GET", "/api/runs/0/frames/12/0", "Range: bytes=0-10,20-\r\n"),
              request("GET", "/api/runs/0/series:1/12/0", "Accept-Encoding: gzip, br\r\n"),
              request("GET", "/api/runs/0/routes/1?x=%41&y", ""),
              request("GET", "/../private.txt", ""),
              request("POST", "/api/control", token + "Content-Length: 19\r\n") +
                  R"({"command":"pause"})",
              request("POST", "/api/control", token + "Transfer-Encoding: chunked\r\n") +
                  "13\r\n{\"command\":\"pause\"}\r\n0\r\n\r\n",
              request("POST", "/api/control",
                      token + "Content-Type: multipart/form-data; boundary=x\r\nContent-Length: "
                              "60\r\n") +
                  "--x\r\nContent-Disposition: form-data; name=\"a\"\r\n\r\nb\r\n--x--\r\n"};
  }

  std::string next() {
    std::string bytes = seeds_[below(seeds_.size())];
    const std::size_t changes = below(6);
    for (std::size_t i = 0; i < changes; ++i) change(bytes);
    return bytes;
  }

 private:
  std::string request(const char* method, const char* path, const std::string& headers) const {
    return fmt::format("{} {} HTTP/1.1\r\nHost: {}\r\n{}\r\n", method, path, own_, headers);
  }
  std::size_t below(std::size_t end) { return random_() % end; }

  void change(std::string& bytes) {
    static const std::vector<std::string> kPieces = {"\r\n",
                                                     "..",
                                                     "/",
                                                     "%2e%2e%2f",
                                                     "%",
                                                     "%00",
                                                     std::string(1, '\0'),
                                                     ":",
                                                     "-1",
                                                     "99999999999999999999",
                                                     "Host: evil.example\r\n",
                                                     "Origin: null\r\n",
                                                     "Content-Length: 5\r\n",
                                                     "Content-Length: -1\r\n",
                                                     "Transfer-Encoding: chunked\r\n",
                                                     "Expect: 100-continue\r\n",
                                                     "Range: bytes=5-1\r\n",
                                                     "Content-Encoding: gzip\r\n",
                                                     "private.txt",
                                                     std::string(5000, 'a'),
                                                     std::string(9000, '1'),
                                                     "\xff\xfe"};
    const std::size_t place = below(bytes.size() + 1);
    switch (below(5)) {
      case 0:
        if (place < bytes.size()) bytes[place] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.insert(place, kPieces[below(kPieces.size())]);
        break;
      case 2:
        bytes.erase(place, below(20));
        break;
      case 3:
        bytes.insert(place, bytes.substr(below(bytes.size() + 1), below(60)));
        break;
      default:
        bytes.resize(bytes.size() - below(bytes.size() / 4 + 1));
    }
    if (bytes.empty()) bytes = "G";
  }

  std::mt19937 random_{20260101};
  std::string own_;
  std::vector<std::string> seeds_;
};

TEST_F(ViewServerTest, GarbageNeitherEndsItNorGetsAFile) {
  start(&control);
  const char* const asked = std::getenv("BARAKA_MUTATIONS");
  const int count = asked != nullptr ? std::atoi(asked) : 2000;
  Mutations mutations(server->port(), token_header());
  for (int i = 0; i < count; ++i) {
    const std::string bytes = mutations.next();
    const std::string answer = answer_to(server->port(), bytes, 5);
    ASSERT_EQ(answer.find(kSecret), std::string::npos) << bytes;
    ASSERT_EQ(answer.find("SQLite format"), std::string::npos) << bytes;
    ASSERT_EQ(answer.find("root:"), std::string::npos) << bytes;
  }
  EXPECT_EQ(status_of(get("/api/runs/0/world")), 200);
}

}  // namespace
}  // namespace view::server::test
