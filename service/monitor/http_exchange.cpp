#include "monitor/http_exchange.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "monitor/failure.hpp"

namespace gyrod::monitor {
namespace {

using Header = std::pair<std::string, std::string>;

/// Of every answer that does not say otherwise.
constexpr std::array<std::pair<const char*, const char*>, 5> kHeaders = {{
    {"Cache-Control", "no-store"},
    {"Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'"},
    {"Referrer-Policy", "no-referrer"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
}};
constexpr std::string_view kText = "text/plain; charset=utf-8";

/// One request in, one answer out.
class TextStream final : public httplib::Stream {
 public:
  explicit TextStream(std::string_view in) : in_(in) {}

  using httplib::Stream::write;
  [[nodiscard]] bool is_readable() const override { return true; }
  [[nodiscard]] bool is_writable() const override { return true; }
  ssize_t read(char* bytes, std::size_t size) override {
    const std::size_t count = in_.copy(bytes, size);
    in_.remove_prefix(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, std::size_t size) override {
    out_.append(bytes, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  [[nodiscard]] int socket() const override { return -1; }

  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string_view in_;
  std::string out_;
};

bool starts_with_name(std::string_view line, std::string_view name) {
  return line.size() > name.size() && line[name.size()] == ':' &&
         std::equal(name.begin(), name.end(), line.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

/// Ranges are not served: a thousand of them in one request ask for a thousand times the answer. They are taken
/// out because cpp-httplib acts on what it reads.
std::string without_ranges(std::string_view head) {
  std::string kept;
  while (!head.empty()) {
    const std::string_view line = head.substr(0, std::min(head.find('\n'), head.size() - 1) + 1);
    if (!starts_with_name(line, "range")) kept += line;
    head.remove_prefix(line.size());
  }
  return kept;
}

bool has_body(const httplib::Request& request) {
  const std::string length = request.get_header_value("Content-Length");
  return request.has_header("Transfer-Encoding") || (!length.empty() && length != "0");
}

/// What cpp-httplib would do by itself and is not wanted: compress at the highest effort (Brotli, seconds for large
/// answers), and answer twice. Behind a body that nobody reads there is no next request.
void tame(httplib::Request& request) {
  const bool gzip = request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos;
  request.headers.erase("Accept-Encoding");
  if (gzip) request.headers.emplace("Accept-Encoding", "gzip");
  request.headers.erase("Expect");
  if (!has_body(request)) return;
  request.headers.erase("Connection");
  request.headers.emplace("Connection", "close");
}

/// Of what does not go through cpp-httplib.
std::string first_line(int status) {
  const std::string_view reason = status == 200   ? "OK"
                                  : status == 304 ? "Not Modified"
                                  : status == 408 ? "Request Timeout"
                                  : status == 429 ? "Too Many Requests"
                                                  : "Request Header Fields Too Large";
  return "HTTP/1.1 " + std::to_string(status) + " " + std::string(reason) + "\r\n";
}

/// Of an answer with its first line, "HTTP/1.1 200 OK"; 0 if there is none.
int status_of(std::string_view answer) {
  constexpr std::size_t kBegin = std::string_view("HTTP/1.1 ").size();
  int status = 0;
  if (answer.size() >= kBegin + 3)
    std::from_chars(answer.data() + kBegin, answer.data() + kBegin + 3, status);
  return status;
}

/// Whether the client has what it would be answered (RFC 9110, section 13.1.2: tags are compared weakly).
bool is_held(const httplib::Request& request, const Answer& answer) {
  const auto tag = std::ranges::find(answer.headers, "ETag", &Header::first);
  if (answer.status != 200 || tag == answer.headers.end()) return false;
  const std::string held = request.get_header_value("If-None-Match");
  return held == "*" || held.find(tag->second.substr(tag->second.find('"'))) != std::string::npos;
}

void add_default_headers(std::vector<Header>& headers) {
  for (const auto& [name, value] : kHeaders) {
    if (std::ranges::find(headers, name, &Header::first) == headers.end()) headers.emplace_back(name, value);
  }
}

std::string with_head(const Answer& answer, bool keep_open = false) {
  std::vector<Header> headers = answer.headers;
  if (answer.status != 304) headers.emplace_back("Content-Type", answer.content_type);
  headers.emplace_back("Connection", keep_open ? "keep-alive" : "close");
  if (answer.events) headers.emplace_back("X-Accel-Buffering", "no");
  add_default_headers(headers);
  std::string text = first_line(answer.status);
  for (const auto& [name, value] : headers) text.append(name).append(": ").append(value).append("\r\n");
  return text + "\r\n";
}

}  // namespace

Reply refusal(int status, Refusal why, std::string_view words) {
  Answer answer{.status = status, .content_type = std::string(kText)};
  if (status == 429) answer.headers.emplace_back("Retry-After", "1");
  return {.bytes = with_head(answer).append(words).append("\n"), .status = status, .refusal = why};
}

HttpExchange::HttpExchange(const Answerer& answer, Gate& gate, StreamHub& streams)
    : answer_(answer), gate_(gate), streams_(streams) {
  set_keep_alive_timeout(kKeepOpenTime.count());
  set_keep_alive_max_count(kMaxRequests);
  // Before cpp-httplib routes anything or reads a body: no body is ever read.
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    respond(request, response);
    return HandlerResponse::Handled;
  });
  set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.status == 400 && response.body.empty())
      response.set_content("no HTTP request\n", std::string(kText));
  });
}

Reply HttpExchange::reply_to(std::string_view head, const std::string& address) {
  const std::string text = without_ranges(head);
  TextStream stream(text);
  constexpr bool kCloseAfterwards = false;
  bool closes = false;
  address_ = address;
  reply_ = {};
  held_.reset();
  understood_ = false;
  const bool whole = process_request(stream, kCloseAfterwards, closes, [&closes](httplib::Request& request) {
    tame(request);
    closes = closes || has_body(request);
  });
  const bool stays = whole && understood_ && !closes;
  if (held_ || reply_.bytes.empty()) {
    reply_.bytes = held_ ? with_head(*held_, stays) : stream.take();
    reply_.keep_open = stays;
  }
  reply_.status = status_of(reply_.bytes);
  if (!understood_) reply_.refusal = reply_.status == 414 ? Refusal::kTooLarge : Refusal::kMalformed;
  return std::move(reply_);
}

void HttpExchange::respond(const httplib::Request& request, httplib::Response& response) {
  understood_ = true;
  Answer answer = answer_to(request);
  reply_.refusal = answer.refusal;
  if (answer.events) {
    reply_.bytes = with_head(answer);
    if (request.method == "HEAD") return;
    reply_.place = streams_.reserve();
    if (reply_.place != nullptr) {
      reply_.bytes += answer.body;
      reply_.events = std::move(answer.events);
      return;
    }
    reply_.bytes.clear();
    reply_.refusal = Refusal::kStreams;
    answer = failure(503, request.path, "as many event streams as gyrod serves are open");
    answer.headers.emplace_back("Retry-After", "10");
  }
  add_default_headers(answer.headers);
  answer.headers.emplace_back("Vary", "Accept-Encoding");
  if (is_held(request, answer)) {
    answer.status = 304;
    held_ = std::move(answer);
    return;
  }
  response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  response.set_header("Content-Type", answer.content_type);
  response.body = std::move(answer.body);
}

Answer HttpExchange::answer_to(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::string authorization = request.get_header_value("Authorization");
  std::optional<Answer> refused =
      gate_.refuse({.path = request.path, .host = host, .authorization = authorization, .address = address_},
                   std::chrono::steady_clock::now());
  if (refused) return std::move(*refused);
  if (request.method != "GET" && request.method != "HEAD") {
    Answer answer = failure(405, request.path, "only GET and HEAD");
    answer.headers.emplace_back("Allow", "GET, HEAD");
    answer.refusal = Refusal::kMethod;
    return answer;
  }
  try {
    return answer_({.path = request.path,
                    .raw_path = request.target.substr(0, request.target.find('?')),
                    .query = {request.params.begin(), request.params.end()},
                    .last_event_id = request.get_header_value("Last-Event-ID")});
  } catch (const std::exception& error) {
    return failure(500, request.path, std::string("internal error: ") + error.what());
  }
}

}  // namespace gyrod::monitor
