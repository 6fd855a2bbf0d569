#include "bus/mismatch_text.hpp"

#include <algorithm>

namespace gyrod::bus {
namespace {

/// The configuration's key for one policy, e.g. "bus.ros2.input_deadline_s".
std::string key(const Mismatch& mismatch, const std::string& name) {
  const std::string direction(kDirectionNames[static_cast<std::size_t>(mismatch.direction)]);
  return mismatch.ros2 ? "bus.ros2." + direction + "_" + name : "bus." + direction + "." + name;
}

/// What to set so that these two match; empty where gyrod has no key for it.
std::string remedy(const Mismatch& mismatch, const Difference& difference) {
  const bool input = mismatch.direction == Direction::kInput;
  const bool no_promise = difference.policy == Policy::kDeadline && difference.offered == "none";
  const std::string than_asked = !input       ? " to what it asks for, or less"
                                 : no_promise ? " to 0"
                                              : " to what it offers, or 0";
  switch (difference.policy) {
    case Policy::kType:
      return "give one of them another topic";
    case Policy::kReliability:
      return "set " + key(mismatch, "reliability") + (input ? " to \"auto\"" : " to \"reliable\"");
    case Policy::kDeadline:
      return "set " + key(mismatch, "deadline_s") + than_asked;
    case Policy::kLiveliness:
      return "set " + key(mismatch, "liveliness") + " and " + key(mismatch, "liveliness_lease_s") +
             than_asked;
    default:
      return "let " + std::string(input ? "it offer that" : "it ask for that");
  }
}

std::string words_of(Policy policy) {
  std::string name(kPolicyNames[static_cast<std::size_t>(policy)]);
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string both_values(const Mismatch& mismatch, const Difference& difference) {
  const bool input = mismatch.direction == Direction::kInput;
  const std::string& theirs = input ? difference.offered : difference.asked;
  const std::string& ours = input ? difference.asked : difference.offered;
  if (difference.policy == Policy::kType) return "it has type '" + theirs + "', gyrod has '" + ours + "'";
  const std::string name = words_of(difference.policy);
  return input ? "it offers " + name + " " + theirs + ", gyrod asks for " + ours
               : "it asks for " + name + " " + theirs + ", gyrod offers " + ours;
}

}  // namespace

std::string mismatch_text(const Mismatch& mismatch, const std::vector<Difference>& differences) {
  const bool input = mismatch.direction == Direction::kInput;
  std::string values;
  std::string remedies;
  for (const Difference& difference : differences) {
    values += (values.empty() ? "" : ", and ") + both_values(mismatch, difference);
    remedies += (remedies.empty() ? "" : ", and ") + remedy(mismatch, difference);
  }
  return "topic '" + std::string(mismatch.topic) + "': a " + (input ? "writer" : "reader") + " of " +
         std::string(mismatch.peer) + " does not match: " + values + "; " + remedies;
}

}  // namespace gyrod::bus
