// How often the family and the orders of a simulated series are found, for docs/method.md:
//
//   identification_study [SEEDS [SAMPLES]]
//
// First a table of fixed processes, then one of processes drawn at random: roots of modulus 0.4 to 0.9, the leading coefficients away
// from 0, no AR root near an MA root.
#include <array>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/denoise/identification.hpp"
#include "support/arma_process.hpp"

namespace {

using namespace gyrod;
using core::Identification;
using core::Identifier;
using testing::ArmaProcess;
using Root = std::complex<double>;

std::string name_of(std::size_t p, std::size_t q) {
  if (p == 0 && q == 0) return "white";
  if (q == 0) return "AR(" + std::to_string(p) + ")";
  if (p == 0) return "MA(" + std::to_string(q) + ")";
  return "ARMA(" + std::to_string(p) + "," + std::to_string(q) + ")";
}

core::ModelFamily family_of(const ArmaProcess& process) {
  if (process.q() == 0) return process.p() == 0 ? core::ModelFamily::kWhite : core::ModelFamily::kAr;
  return process.p() == 0 ? core::ModelFamily::kMa : core::ModelFamily::kArma;
}

struct Score {
  unsigned tried = 0;
  unsigned orders = 0;
  unsigned family = 0;
  unsigned by_correlations = 0;
  unsigned adequate = 0;
  std::map<std::string, unsigned> wrong;

  void add(const ArmaProcess& truth, const Identification& found) {
    ++tried;
    const bool right = found.model.p == truth.p() && found.model.q == truth.q();
    orders += right ? 1U : 0U;
    family += found.model.family() == family_of(truth) ? 1U : 0U;
    by_correlations += found.by_correlations == family_of(truth) ? 1U : 0U;
    adequate += found.residuals.adequate ? 1U : 0U;
    if (!right) ++wrong[name_of(found.model.p, found.model.q)];
  }

  void print(const std::string& title) const {
    std::printf("%-34s %5u %7u %7u %12u %9u  ", title.c_str(), tried, orders, family, by_correlations,
                adequate);
    for (const auto& [what, count] : wrong) std::printf(" %s %u", what.c_str(), count);
    std::printf("\n");
  }
};

std::string title_of(const ArmaProcess& process) {
  std::string text = name_of(process.p(), process.q());
  const auto add = [&text](double value) {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), " %.2g", value);
    text += digits.data();
  };
  for (const double value : process.a) add(value);
  if (process.q() > 0) text += " |";
  for (const double value : process.b) add(value);
  return text;
}

void fixed_processes(unsigned seeds, std::size_t samples) {
  const std::vector<ArmaProcess> processes = {{{0.7}, {}},
                                              {{1.2, -0.5}, {}},
                                              {{-0.6}, {}},
                                              {{0.5, 0.3}, {}},
                                              {{2.2, -2.4, 1.4, -0.5}, {}},
                                              {{0.4, -0.3, 0.2, -0.3}, {}},
                                              {{0.5, 0.0, 0.0, 0.0, 0.0, 0.3}, {}},
                                              {{}, {0.6}},
                                              {{}, {-0.8}},
                                              {{}, {0.8, 0.4}},
                                              {{}, {-1.0, 0.5}},
                                              {{}, {0.7, 0.5, 0.4}},
                                              {{}, {0.5, -0.4, 0.3}},
                                              {{0.7}, {0.4}},
                                              {{0.9}, {-0.5}},
                                              {{1.2, -0.5}, {0.5}},
                                              {{0.5, 0.3}, {0.6}},
                                              {{1.2, -0.5}, {0.6, 0.3}},
                                              {{0.6}, {0.5, 0.4}},
                                              {{1.5, -0.8}, {-0.4, 0.5}},
                                              {{0.98}, {}},
                                              {{0.95}, {-0.7}},
                                              {{}, {}}};
  Identifier identifier(samples);
  for (const ArmaProcess& process : processes) {
    Score score;
    for (unsigned seed = 1; seed <= seeds; ++seed)
      score.add(process, identifier.identify(testing::realisation(process, samples, seed)));
    score.print(title_of(process));
  }
}

/// Roots in conjugate pairs, one real one where the count is odd.
std::vector<Root> random_roots(std::size_t count, std::mt19937_64& bits) {
  std::uniform_real_distribution<double> modulus(0.4, 0.9);
  std::uniform_real_distribution<double> angle(0.15 * std::numbers::pi, 0.85 * std::numbers::pi);
  std::vector<Root> roots;
  if (count % 2 == 1) roots.emplace_back(bits() % 2 == 0 ? modulus(bits) : -modulus(bits));
  while (roots.size() < count) {
    roots.push_back(std::polar(modulus(bits), angle(bits)));
    roots.push_back(std::conj(roots.back()));
  }
  return roots;
}

/// c_1 .. c_n of (1 - r_1 z)(1 - r_2 z) ... = 1 + c_1 z + ... + c_n z^n.
std::vector<double> polynomial(const std::vector<Root>& roots) {
  std::vector<Root> c = {1.0};
  for (const Root& root : roots) {
    c.push_back(0.0);
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] -= root * c[i - 1];
  }
  std::vector<double> real;
  for (std::size_t i = 1; i < c.size(); ++i) real.push_back(c[i].real());
  return real;
}

ArmaProcess random_process(std::size_t p, std::size_t q, std::mt19937_64& bits) {
  while (true) {
    const auto ar = random_roots(p, bits);
    const auto ma = random_roots(q, bits);
    double nearest = 1.0;
    for (const Root& one : ar) {
      for (const Root& other : ma) nearest = std::min(nearest, std::abs(one - other));
    }
    if (nearest < 0.4) continue;
    ArmaProcess process{polynomial(ar), polynomial(ma)};
    for (double& value : process.a) value = -value;
    const bool weak =
        (p > 0 && std::abs(process.a.back()) < 0.15) || (q > 0 && std::abs(process.b.back()) < 0.15);
    if (!weak) return process;
  }
}

void random_processes(unsigned seeds, std::size_t samples) {
  std::mt19937_64 bits(1);
  Identifier identifier(samples);
  constexpr std::array<std::pair<std::size_t, std::size_t>, 12> kOrders = {
      {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 2}}};
  for (const auto& [p, q] : kOrders) {
    Score score;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const ArmaProcess process = random_process(p, q, bits);
      score.add(process, identifier.identify(testing::realisation(process, samples, seed)));
    }
    score.print("random " + name_of(p, q));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seeds = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 100;
  const std::size_t samples = argc > 2 ? static_cast<std::size_t>(std::atoi(argv[2])) : 5000;
  std::printf("%zu samples%23s %5s %7s %7s %12s %9s   wrong ones\n", samples, "tried", "", "orders", "family",
              "Table 2 says", "adequate");
  fixed_processes(seeds, samples);
  random_processes(seeds, samples);
  return 0;
}
