#include "support/network_namespace.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sched.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace gyrod::testing {
namespace {

void on_new_thread(const std::function<void()>& function) {
  std::exception_ptr thrown;
  std::thread([&] {
    try {
      function();
    } catch (...) {
      thrown = std::current_exception();
    }
  }).join();
  if (thrown) std::rethrow_exception(thrown);
}

void check(int result, const char* attempt) {
  if (result < 0) throw std::runtime_error(std::string(attempt) + ": " + std::strerror(errno));
}

}  // namespace

/// Lives as long as its descriptor: no process or name keeps it.
class TestNetwork::Namespace {
 public:
  Namespace() {
    on_new_thread([this] {
      check(unshare(CLONE_NEWNET), "a network namespace");
      descriptor_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
      check(descriptor_, "keep a network namespace");
    });
  }
  ~Namespace() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Namespace(const Namespace&) = delete;
  Namespace& operator=(const Namespace&) = delete;

  void run(const std::function<void()>& function) const {
    on_new_thread([&] {
      check(setns(descriptor_, CLONE_NEWNET), "enter a network namespace");
      function();
    });
  }

  [[nodiscard]] std::string path() const {
    return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_ = -1;
};

std::string TestNetwork::why_not() {
  if (geteuid() != 0) return "network namespaces need root";
  try {
    const TestNetwork network(1);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TestNetwork::TestNetwork(std::size_t hosts) : bridge_(std::make_unique<Namespace>()) {
  // No snooping: it would have to learn who wants which multicast before it passes any on.
  run_ip(*bridge_, "ip link add br0 type bridge mcast_snooping 0; ip link set br0 up");
  for (std::size_t k = 1; k <= hosts; ++k) {
    const Namespace& host = *hosts_.emplace_back(std::make_unique<Namespace>());
    const std::string port = "port" + std::to_string(k);
    run_ip(*bridge_, "ip link add " + port + " type veth peer name eth0 netns " + host.path() +
                         "; ip link set " + port + " master br0 up");
    run_ip(host, "ip link set lo up; ip address add 10.77.0." + std::to_string(k) +
                     "/24 dev eth0; ip link set eth0 up");
  }
}

TestNetwork::~TestNetwork() = default;

void TestNetwork::on(std::size_t host, const std::function<void()>& function) const {
  hosts_.at(host - 1)->run(function);
}

void TestNetwork::set_link(std::size_t host, bool up) const {
  run_ip(*hosts_.at(host - 1), std::string("ip link set eth0 ") + (up ? "up" : "down"));
}

void TestNetwork::run_ip(const Namespace& where, const std::string& script) const {
  where.run([&] {
    Process ip({"/bin/sh", "-ec", "PATH=$PATH:/usr/sbin:/sbin; " + script}, folder_.path(), "ip");
    if (ip.wait() != 0) throw std::runtime_error("'" + script + "': " + ip.err());
  });
}

}  // namespace gyrod::testing
