#include "view/server/request_check.h"

#include <gtest/gtest.h>

#include "view/server/control_request.h"

namespace view::server {
namespace {

constexpr int kPort = 8123;

RequestHead page_request() {
  RequestHead request;
  request.method = "GET";
  request.path = "/api/view";
  request.hosts = 1;
  request.host = "127.0.0.1:8123";
  return request;
}

int status_of(const RequestHead& request, const std::optional<std::string>& token = {}) {
  const auto refusal = refusal_of(request, kPort, token);
  return refusal ? refusal->status : 200;
}

TEST(RequestCheck, TheHostMustBeThisServer) {
  EXPECT_EQ(status_of(page_request()), 200);
  RequestHead by_name = page_request();
  by_name.host = "localhost:8123";
  EXPECT_EQ(status_of(by_name), 200);
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:8124", "evil.example:8123", "127.0.0.1:81230",
        "127.0.0.1.evil.example:8123", "localhost:8123@evil.example"}) {
    RequestHead request = page_request();
    request.host = host;
    EXPECT_EQ(status_of(request), 421) << host;
  }
  RequestHead request = page_request();
  request.hosts = 2;
  EXPECT_EQ(status_of(request), 421);
}

TEST(RequestCheck, NoOtherPageMayAsk) {
  RequestHead request = page_request();
  request.origins = 1;
  request.origin = "http://127.0.0.1:8123";
  EXPECT_EQ(status_of(request), 200);
  for (const char* origin : {"null", "", "http://localhost:8123", "https://127.0.0.1:8123",
                             "http://evil.example", "http://127.0.0.1:8123.evil.example"}) {
    request.origin = origin;
    EXPECT_EQ(status_of(request), 403) << origin;
  }
  request = page_request();
  request.fetch_site = "cross-site";
  EXPECT_EQ(status_of(request), 403);
  request.path = "/";  // a link
  EXPECT_EQ(status_of(request), 200);
}

TEST(RequestCheck, ARunUnderWayIsReadWithTheToken) {
  RequestHead request = page_request();
  EXPECT_EQ(status_of(request), 200);  // a record is everybody's who may connect
  EXPECT_EQ(status_of(request, "abc"), 403);
  request.token = "abd";
  EXPECT_EQ(status_of(request, "abc"), 403);
  request.token = "abc";
  EXPECT_EQ(status_of(request, "abc"), 200);
  request.token = "";
  request.path = "/";
  EXPECT_EQ(status_of(request, "abc"), 200);
}

TEST(RequestCheck, CommandsNeedTheToken) {
  RequestHead request = page_request();
  request.method = "POST";
  request.path = "/api/control";
  request.token = "abc";
  EXPECT_EQ(status_of(request, "abc"), 200);
  EXPECT_EQ(status_of(request), 403);  // nothing to command
  for (const char* token : {"", "ab", "abd", "abcd"}) {
    request.token = token;
    EXPECT_EQ(status_of(request, "abc"), 403) << token;
  }
  request.token = "abc";
  request.path = "/api/view";
  EXPECT_EQ(status_of(request, "abc"), 405);
  for (const char* method : {"PUT", "HEAD", "OPTIONS", "DELETE", "TRACE", "get"}) {
    request.method = method;
    EXPECT_EQ(status_of(request, "abc"), 405) << method;
  }
}

TEST(Token, IsAnotherOneEachTime) {
  EXPECT_EQ(new_token().size(), 32U);
  EXPECT_NE(new_token(), new_token());
}

template <class Kind>
Kind read(std::string_view body) {
  const auto command = command_in(body);
  return command ? std::get<Kind>(*command) : Kind{};
}

TEST(ControlRequest, ReadsEachCommand) {
  EXPECT_TRUE(std::holds_alternative<Pause>(*command_in(R"({"command":"pause"})")));
  EXPECT_TRUE(std::holds_alternative<Resume>(*command_in(R"({"command":"resume"})")));
  const auto steps = read<Steps>(R"({"command":"step","count":10,"of":"event","agent":3})");
  EXPECT_EQ(steps.of, Steps::Of::kEvent);
  EXPECT_EQ(steps.count, 10);
  EXPECT_EQ(steps.agent, 3);
  EXPECT_EQ(read<Speed>(R"({"command":"speed","factor":2.5})").factor, 2.5);
  const auto made = read<Break>(R"({"command":"break","on":"state","agent":2,"state":"DONE"})");
  EXPECT_EQ(made.on, Break::On::kState);
  EXPECT_EQ(made.state, "DONE");
  EXPECT_EQ(read<Break>(R"({"command":"break","on":"time","at":5})").at, 5);
  EXPECT_EQ(read<Clear>(R"({"command":"clear","id":4})").id, 4);
  EXPECT_EQ(read<DriveByHand>(R"({"command":"drive","agent":3,"vx":0.5,"omega":-1})").omega, -1);
}

TEST(ControlRequest, NamesWhatIsWrong) {
  const auto mistake = [](std::string_view body) {
    const auto command = command_in(body);
    return command ? "none" : command.error().message;
  };
  EXPECT_EQ(mistake("garbage"), "a command is a JSON object");
  EXPECT_EQ(mistake("[]"), "a command is a JSON object");
  EXPECT_EQ(mistake(std::string(4000, '[')), "a command is a JSON object");
  EXPECT_EQ(mistake("{}"), "command: is missing");
  EXPECT_EQ(mistake(R"({"command":"halt"})"),
            "command: \"halt\" is not one of pause, resume, step, speed, break, clear, drive");
  EXPECT_EQ(mistake(R"({"command":"step","of":"cycle","count":0})"),
            "count: 0 is not a whole number from 1 to 1000000");
  EXPECT_EQ(mistake(R"({"command":"step","of":"cycle","count":1e99})"),
            "count: 1e+99 is not a whole number from 1 to 1000000");
  EXPECT_EQ(mistake(R"({"command":"clear","id":18446744073709551615})"),
            "id: 18446744073709551615 is not a whole number from 0 to 9223372036854775807");
  EXPECT_EQ(mistake(R"({"command":"speed","factor":-1})"),
            "factor: -1 is not a number from 0 to 1000000000");
  EXPECT_EQ(mistake(R"({"command":"break","on":"time"})"), "at: is missing");
  EXPECT_EQ(mistake(R"({"command":"drive","agent":0,"vx":1,"omega":0})"),
            "agent: 0 is not a whole number from 1 to 65533");
}

}  // namespace
}  // namespace view::server
