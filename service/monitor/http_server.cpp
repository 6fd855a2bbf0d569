#include "monitor/http_server.hpp"

#include <cerrno>
#include <chrono>
#include <exception>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include "monitor/connection.hpp"

namespace gyrod::monitor {
namespace {

/// Two scrapers and a person.
constexpr std::size_t kThreads = 3;
/// After a failed accept(), e.g. no descriptor left: others may give some back.
constexpr std::chrono::milliseconds kAcceptPause{100};

}  // namespace

HttpServer::HttpServer(Socket listener, Answerer answer)
    : listener_(std::move(listener)), answer_(std::move(answer)) {
  // Before cpp-httplib routes anything or reads a body: no body is ever read.
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    respond(request, response);
    return HandlerResponse::Handled;
  });
}

HttpServer::~HttpServer() { stop(); }

void HttpServer::start() {
  while (threads_.size() < kThreads) threads_.emplace_back([this] { accept_clients(); });
}

void HttpServer::stop() noexcept {
  stop_.raise();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  listener_ = {};
}

void HttpServer::accept_clients() noexcept {
  while (!stop_.raised()) {
    if (!stop_.wait(listener_.descriptor(), POLLIN, Deadline::max())) continue;
    Socket client(accept4(listener_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (client) {
      serve(std::move(client));
    } else if (errno != EAGAIN) {  // EAGAIN: another thread was faster
      stop_.pause(kAcceptPause);
    }
  }
}

void HttpServer::serve(Socket client) noexcept {
  try {
    Connection connection(std::move(client), stop_);
    constexpr bool kCloseAfterwards = true;
    bool client_closes = false;
    process_request(connection, kCloseAfterwards, client_closes, nullptr);
  } catch (const std::exception&) {
    return;  // out of memory for this client: it is disconnected, the next one may fare better
  }
}

void HttpServer::respond(const httplib::Request& request, httplib::Response& response) const {
  if (request.method != "GET" && request.method != "HEAD") {
    response.status = 405;
    response.set_header("Allow", "GET, HEAD");
    response.set_content("only GET and HEAD\n", "text/plain; charset=utf-8");
    return;
  }
  Answer answer;
  try {
    answer = answer_({.path = request.path,
                      .raw_path = request.target.substr(0, request.target.find('?')),
                      .query = {request.params.begin(), request.params.end()},
                      .last_event_id = request.get_header_value("Last-Event-ID")});
  } catch (const std::exception& error) {
    answer = Answer{.status = 500, .body = std::string("internal error: ") + error.what() + "\n"};
  }
  response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  response.set_content(answer.body, answer.content_type);
}

}  // namespace gyrod::monitor
