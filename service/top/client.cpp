#include "top/client.hpp"

#include <httplib.h>

#include "top/printable.hpp"

namespace gyrod::top {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20U;

const char* reason_of(httplib::Error error, bool too_long) {
  if (too_long) return "the answer is longer than 16 MiB";
  switch (error) {
    case httplib::Error::Connection:
      return "no connection: nobody listens there, or it is out of reach";
    case httplib::Error::ConnectionTimeout:
      return "no connection within 3 s";
    case httplib::Error::Read:
      return "no answer within 5 s, or one that breaks off: does it speak https?";
    case httplib::Error::SSLConnection:
      return "no encrypted connection: does it speak http?";
    case httplib::Error::SSLLoadingCerts:
      return "the file of --ca-file cannot be read as certificates in PEM";
    case httplib::Error::SSLServerVerification:
      return "its certificate is not one that we trust, or of another name (--ca-file)";
    default:
      return "the request failed";
  }
}

}  // namespace

struct Client::Connection {
  explicit Connection(const std::string& origin) : http(origin) {}
  httplib::Client http;
};

Client::Client(const Address& address, const Credentials& credentials)
    : url_(address.url()),
      prefix_(address.prefix),
      connection_(std::make_unique<Connection>(address.origin())) {
  constexpr time_t kConnect_s = 3;
  constexpr time_t kAnswer_s = 5;
  httplib::Client& http = connection_->http;
  if (!http.is_valid()) throw Unreachable(url_ + ": no connection can be made to this address");
  http.set_connection_timeout(kConnect_s);
  http.set_read_timeout(kAnswer_s);
  http.set_write_timeout(kAnswer_s);
  http.set_keep_alive(true);
  tells_who_ = !credentials.token.empty() || !credentials.user.empty();
  http.set_url_encode(false);  // done where the query is made
  if (!credentials.token.empty()) http.set_bearer_token_auth(credentials.token);
  if (!credentials.user.empty()) http.set_basic_auth(credentials.user, credentials.password);
  if (!credentials.ca_file.empty()) http.set_ca_cert_path(credentials.ca_file);
}

Client::~Client() = default;

std::string Client::status_text() { return get("/api/v1/status"); }

std::string Client::sensors_text(const View& view, std::uint64_t offset, std::uint64_t limit) {
  return get(sensors_query(view, offset, limit));
}

std::string Client::events_text(std::uint64_t limit) {
  return get("/api/v1/events?limit=" + std::to_string(limit));
}

void Client::stop() noexcept { connection_->http.stop(); }

std::string Client::get(const std::string& target) {
  std::string body;
  bool too_long = false;
  const auto take = [&](const char* data, std::size_t size) {
    too_long = body.size() + size > kMostBytes;
    if (!too_long) body.append(data, size);
    return !too_long;
  };
  const httplib::Result result = connection_->http.Get(prefix_ + target, take);
  if (!result) throw Unreachable(url_ + ": " + reason_of(result.error(), too_long));
  constexpr int kOk = 200;
  constexpr int kWho = 401;
  constexpr int kNotYou = 403;
  if (result->status == kOk) return body;
  const std::string why = refusal(result->status, target, parse_error(body));
  if (result->status == kWho || result->status == kNotYou) throw Forbidden(why);
  throw Unreachable(why);
}

std::string Client::refusal(int status, const std::string& target, const std::string& words) const {
  constexpr int kWho = 401;
  constexpr int kNoSuch = 404;
  if (status == kNoSuch && words.empty())
    return url_ + " has no " + target.substr(0, target.find('?')) +
           ": is it a gyrod, and as new as this one?";
  std::string said = url_ + " answers " + std::to_string(status) + (words.empty() ? "" : ", " + words);
  if (status != kWho) return said;
  return said + (tells_who_ ? ": it does not know the token or user that was given"
                            : ": give --token-file or --user-file");
}

}  // namespace gyrod::top
