/// `gyrod top` at a terminal and in scripts, before a server that answers as the API's contract has it, and worse.
#include <atomic>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include "rig.hpp"
#include "support/api_answers.hpp"
#include "support/eventually.hpp"
#include "support/pseudo_terminal.hpp"

namespace gyrod::testing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// Answers on a free port of this machine.
class Server {
 public:
  Server() {
    answer("/api/v1/status", status_json());
    answer("/api/v1/events", events_json());
    port_ = http_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { http_.listen_after_bind(); });
  }
  ~Server() {
    http_.stop();
    thread_.join();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void answer(const std::string& path, const std::string& json, int status = 200) {
    http_.Get(path, [json, status](const httplib::Request&, httplib::Response& response) {
      response.status = status;
      response.set_content(json, "application/json");
    });
  }
  void sensors(const std::string& rows, int count) { answer("/api/v1/channels", sensors_json(rows, count)); }
  [[nodiscard]] std::string url() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  httplib::Server http_;
  int port_ = 0;
  std::thread thread_;
};

class Top : public Rig {};

TEST_F(Top, UnderstandsARealGyrod) {
  const auto daemon = start_daemon({});
  const std::string url = "127.0.0.1:" + std::to_string(port_of(*daemon));
  const auto nobody = run({"top", url, "--once"});
  EXPECT_EQ(nobody.exit_code, 6) << nobody.err;
  EXPECT_THAT(nobody.err, HasSubstr("no gyro has sent anything yet"));

  const auto sensor = start_on_bus({"simulate", "--sensor", "front/left", "--batch", "5"});
  EXPECT_TRUE(eventually([&] {
    const auto table =
        run({"top", url, "--once", "--search", "t/le", "--health", "warming_up,ok", "--sort", "noise_in"});
    return table.exit_code == 0 && table.out.find(" front/left 100.0") != std::string::npos;
  }));
  for (const char* sort : {"health", "sensor", "reduction", "rate"})
    EXPECT_THAT(run({"top", url, "--json", "--sort", sort}).out, HasSubstr("\"sensor\": \"front/left\""));
  sensor->signal(SIGTERM);
  sensor->wait();
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Top, PrintsOneTableAndSaysByItsExitCodeWhetherAllIsWell) {
  Server well;
  well.sensors(sensor_json("front", "ok"), 1);
  const auto table = run({"top", well.url(), "--once"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("health sensor rate_hz"), HasSubstr("ok     front  99.97"),
                               Not(HasSubstr("\x1b"))));

  Server troubled;
  troubled.sensors(sensor_json("front", "noisy"), 1);
  EXPECT_EQ(run({"top", troubled.url(), "--once"}).exit_code, 8);
  const auto json = run({"top", troubled.url(), "--json"});
  EXPECT_EQ(json.exit_code, 8);
  EXPECT_THAT(json.out, AllOf(HasSubstr("\"sensor\": \"front\""), HasSubstr("\"uptime_s\": 7500.5")));
}

TEST_F(Top, NamesTheUrlWhereThereIsNoAnswerOrNoGyrod) {
  const auto nobody = run({"top", "127.0.0.1:1", "--once"});
  EXPECT_EQ(nobody.exit_code, 5);
  EXPECT_THAT(nobody.err, HasSubstr("http://127.0.0.1:1: no connection"));

  Server other;
  other.answer("/api/v1/channels", "<html>");
  const auto html = run({"top", other.url(), "--once"});
  EXPECT_EQ(html.exit_code, 5);
  EXPECT_THAT(html.err, AllOf(HasSubstr(other.url()), HasSubstr("not JSON")));

  Server who;
  who.answer("/api/v1/channels", R"({"error": "who are you?"})", 401);
  const auto forbidden = run({"top", who.url(), "--once"});
  EXPECT_EQ(forbidden.exit_code, 7);
  EXPECT_THAT(forbidden.err, AllOf(HasSubstr("who are you?"), HasSubstr("--token-file")));

  EXPECT_EQ(run({"top", "ftp://car7", "--once"}).exit_code, 2);
  EXPECT_EQ(run({"top", "car7", "--once", "--token-file", "/no/such/file"}).exit_code, 4);
  const auto no_terminal = run({"top", who.url()});
  EXPECT_EQ(no_terminal.exit_code, 2);
  EXPECT_THAT(no_terminal.err, HasSubstr("--once"));
}

TEST_F(Top, TellsWhoAsksByAFile) {
  std::atomic<int> known{0};
  httplib::Server http;
  http.Get("/api/v1/.*", [&known](const httplib::Request& request, httplib::Response& response) {
    const std::string who = request.get_header_value("Authorization");
    if (who == "Bearer secret" || who == "Basic YW5uOnBhc3M6d29yZA==") ++known;
    const bool status = request.path.ends_with("status");
    response.set_content(status ? status_json() : sensors_json(sensor_json("front", "ok"), 1),
                         "application/json");
  });
  const int port = http.bind_to_any_port("127.0.0.1");
  std::thread thread([&http] { http.listen_after_bind(); });
  write_file("token", "secret\n");
  write_file("user", "ann:pass:word\n");
  const std::string url = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(run({"top", url, "--once", "--token-file", path("token")}).exit_code, 0);
  EXPECT_EQ(run({"top", url, "--once", "--user-file", path("user")}).exit_code, 0);
  http.stop();
  thread.join();
  EXPECT_EQ(known, 4);
}

TEST_F(Top, ShowsASensorFullScreenAndGivesTheTerminalBackOnQ) {
  Server server;
  server.sensors(sensor_json(R"(front\u001b]0;owned\u0007)", "noisy"), 1);
  PseudoTerminal terminal({binary(), "top", server.url()}, 100, 24);
  ASSERT_TRUE(eventually([&] { return terminal.said("front?]0;owned?"); })) << terminal.text();
  EXPECT_FALSE(terminal.is_cooked());
  terminal.resize(60, 10);
  terminal.press("u");
  EXPECT_TRUE(eventually([&] { return terminal.said("rad/s"); }));
  terminal.press("q");
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_TRUE(terminal.is_cooked());
  EXPECT_THAT(terminal.text(),
              AllOf(HasSubstr("\x1b[?1049h"), EndsWith("\x1b[?25h\x1b[?1049l"), Not(HasSubstr("\x1b]0"))));
}

TEST_F(Top, GivesTheTerminalBackOnASignalWhileNobodyAnswers) {
  PseudoTerminal terminal({binary(), "top", "127.0.0.1:1"}, 80, 24);
  ASSERT_TRUE(eventually([&] { return terminal.said("no connection"); })) << terminal.text();
  terminal.signal(SIGTERM);
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_TRUE(terminal.is_cooked());
  EXPECT_THAT(terminal.text(), EndsWith("\x1b[?1049l"));
}

}  // namespace
}  // namespace gyrod::testing
