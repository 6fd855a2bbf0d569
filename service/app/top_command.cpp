#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/errors.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "files/file_error.hpp"
#include "settings/text_file.hpp"
#include "stream/health.hpp"
#include "top/client.hpp"
#include "top/listing.hpp"
#include "top/poller.hpp"
#include "top/screen.hpp"
#include "top/terminal.hpp"
#include "top/view.hpp"

namespace gyrod::app {
namespace {

struct TopFlags {
  std::string url = "http://127.0.0.1:9464";
  bool once = false;
  bool json = false;
  bool troubled = false;
  bool no_colour = false;
  bool radians = false;
  std::string token_file;
  std::string user_file;
  std::string ca_file;
  top::View view;
};

std::string first_line(const std::string& file) {
  const settings::TextFile text = settings::read_text_file(file, 1);
  if (!text.trouble.empty()) throw files::FileError(text.trouble);
  std::string line = text.text.substr(0, text.text.find('\n'));
  if (line.ends_with('\r')) line.pop_back();
  if (line.empty()) throw files::FileError(file + ": its first line is empty");
  return line;
}

top::Credentials credentials_of(const TopFlags& flags) {
  top::Credentials credentials;
  credentials.ca_file = flags.ca_file;
  if (!flags.token_file.empty()) credentials.token = first_line(flags.token_file);
  if (flags.user_file.empty()) return credentials;
  const std::string line = first_line(flags.user_file);
  const std::size_t colon = line.find(':');
  if (colon == 0 || colon == std::string::npos)
    throw files::FileError(flags.user_file + ": expected USER:PASSWORD as its first line");
  credentials.user = line.substr(0, colon);
  credentials.password = line.substr(colon + 1);
  return credentials;
}

/// Says `what` to standard output. @return whether gyrod and all sensors that were chosen are well
int once(const TopFlags& flags, top::Client& client) {
  constexpr std::uint64_t kAtOnce = 1000;
  const std::string status_text = client.status_text();
  const top::Status status = top::parse_status(status_text);
  nlohmann::json whole = {{"status", flags.json ? nlohmann::json::parse(status_text) : nlohmann::json()},
                          {"channels", nlohmann::json::array()}};
  std::vector<top::Sensor> sensors;
  for (bool more = true; more;) {
    const std::string text = client.sensors_text(flags.view, sensors.size(), kAtOnce);
    const top::SensorPage page = top::parse_sensors(text);
    sensors.insert(sensors.end(), page.sensors.begin(), page.sensors.end());
    more = !page.sensors.empty() && sensors.size() < page.matching;
    if (!flags.json) continue;
    nlohmann::json parsed = nlohmann::json::parse(text);
    for (auto& row : parsed["channels"]) whole["channels"].push_back(std::move(row));
  }
  const std::string text = flags.json
                               ? whole.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n"
                               : top::listing(sensors);
  std::fputs(text.c_str(), stdout);
  if (status.open == 0) {
    std::fprintf(stderr, "gyrod: %s: no gyro has sent anything yet\n", client.url().c_str());
    return kIncomplete;
  }
  if (!status.ready)
    std::fprintf(stderr, "gyrod: %s: not ready: %s\n", client.url().c_str(), status.ready_reason.c_str());
  return top::all_well(status, sensors) ? kDone : kTroubled;
}

bool wants_colour(const TopFlags& flags) {
  const char* no_color = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe): before any thread
  return !flags.no_colour && (no_color == nullptr || *no_color == '\0');
}

/// Until q or a signal.
int watch(const TopFlags& flags, top::Client& client, Interrupt& interrupt) {
  constexpr std::chrono::milliseconds kKeyWait{100};
  const bool coloured = wants_colour(flags);
  top::View view = flags.view;
  top::Poller poller(client);
  const top::Terminal terminal;
  std::string shown;
  std::string bytes;
  for (bool going = true; going && !interrupt.requested();) {
    const top::Size size = top::Terminal::size();
    const std::uint64_t rows = top::sensor_rows(size);
    const top::Poller::Known known = poller.known();
    const std::uint64_t matching = known.picture.page ? known.picture.page->matching : 0;
    top::keep_in_sight(view, matching, rows);
    poller.want(view, rows);
    std::string frame = top::painted(top::screen(known.picture, view, size), size, coloured);
    if (frame != shown) top::Terminal::write(frame);
    shown = std::move(frame);
    if (!top::Terminal::read(bytes, kKeyWait)) return kDone;
    for (const top::KeyPress key : top::keys_of(bytes))
      going = going && top::press(view, key, matching, rows);
  }
  return kDone;
}

int run_top(TopFlags flags, Interrupt& interrupt) {
  top::Address address;
  try {
    address = top::parse_address(flags.url);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("URL", error.what());
  }
  if (flags.troubled) flags.view.health = top::troubled_states();
  if (flags.radians) flags.view.unit = top::RateUnit::kRadPerS;
  if (!flags.once && !flags.json && !top::Terminal::is_there())
    throw CLI::ValidationError("top", "needs a terminal; --once prints a table instead");
  try {
    top::Client client(address, credentials_of(flags));
    if (!flags.once && !flags.json) return watch(flags, client, interrupt);
    interrupt.let_through();
    return once(flags, client);
  } catch (const top::Unreachable& error) {
    throw Unavailable(error.what());
  } catch (const top::AnswerError& error) {
    throw Unavailable(address.url() + ": " + error.what());
  } catch (const top::Forbidden& error) {
    std::fprintf(stderr, "gyrod: %s\n", error.what());
    return kNotAllowed;
  }
}

std::vector<std::string> health_names() {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < stream::kHealthStates; ++n)
    names.emplace_back(stream::name_of(static_cast<stream::Health>(n)));
  return names;
}

void add_choice(CLI::App& command, TopFlags& flags) {
  command
      .add_option("--sort", flags.view.sort,
                  "health (worst first), sensor, noise_in, reduction or rate [health]")
      ->type_name("KEY")
      ->check(one_of({std::begin(top::kSorts), std::end(top::kSorts)}));
  command.add_option("--search", flags.view.search, "Only sensors with this in their name")
      ->type_name("TEXT");
  CLI::Option* health =
      command
          .add_option("--health", flags.view.health,
                      "Only sensors in these states, separated by commas, e.g. noisy,silent")
          ->type_name("LIST")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(one_of(health_names()));
  command.add_flag("--troubled", flags.troubled, "Only sensors in another state than ok and warming_up")
      ->excludes(health);
}

void add_access(CLI::App& command, TopFlags& flags) {
  CLI::Option* token = command
                           .add_option("--token-file", flags.token_file,
                                       "File with the bearer token, where gyrod asks for one")
                           ->type_name("FILE");
  command.add_option("--user-file", flags.user_file, "File with USER:PASSWORD, where it asks for that")
      ->type_name("FILE")
      ->excludes(token);
  command.add_option("--ca-file", flags.ca_file, "Authority of its certificate, PEM [those of the system]")
      ->type_name("FILE")
      ->check(CLI::ExistingFile.description(""));
}

}  // namespace

void add_top(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("top", "The live page at a terminal, of this or another machine's gyrod");
  const auto flags = std::make_shared<TopFlags>();
  command
      ->add_option("url", flags->url,
                   "HOST, HOST:PORT (9464 where left out), or a URL [http://127.0.0.1:9464]")
      ->type_name("URL");
  command->add_flag("--once", flags->once, "Print one table without colour and end");
  command->add_flag("--json", flags->json, "As --once, in the words of the API: {\"status\", \"channels\"}");
  add_choice(*command, *flags);
  command->add_flag("--rad", flags->radians, "Rates in rad/s on the screen [deg/s]");
  command->add_flag("--no-colour,--no-color", flags->no_colour, "As the variable NO_COLOR does");
  add_access(*command, *flags);
  command->footer(
      "Noise in and out are those of a sensor's loudest axis; the chosen sensor is shown with all three.\n"
      "Keys: q quit, / search, s sort, t troubled only, u unit, arrows, page up and down, home and end.\n\n"
      "Exit codes of --once: 0 gyrod is ready and no sensor that was listed is troubled; 5 no answer;\n"
      "6 no sensor has sent anything yet; 7 it asks who you are; 8 not ready, or a sensor is troubled.\n\n"
      "Examples:\n"
      "  gyrod top\n"
      "  gyrod top car7 --troubled\n"
      "  gyrod top https://car7:9464 --token-file token --ca-file ca.pem\n"
      "  gyrod top --once --sort noise_in | head");
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return run_top(*flags, interrupt); }; });
}

}  // namespace gyrod::app
