#include "monitor/rate_limit.hpp"

#include <algorithm>

namespace gyrod::monitor {

bool RateLimit::allows(const std::string& address, Time now) {
  const std::scoped_lock lock(mutex_);
  const auto found = buckets_.find(address);
  if (found == buckets_.end() && buckets_.size() < options_.max_addresses) return true;
  return bucket_of(address, now).tokens >= 1.0;
}

bool RateLimit::take(const std::string& address, Time now) {
  const std::scoped_lock lock(mutex_);
  Bucket& bucket = bucket_of(address, now);
  if (bucket.tokens < 1.0) return false;
  bucket.tokens -= 1.0;
  return true;
}

RateLimit::Bucket& RateLimit::bucket_of(const std::string& address, Time now) {
  auto found = buckets_.find(address);
  if (found == buckets_.end() && buckets_.size() >= options_.max_addresses) forget_full_ones(now);
  if (found == buckets_.end()) {
    const bool room = buckets_.size() < options_.max_addresses;
    found = buckets_.try_emplace(room ? address : std::string(), Bucket{options_.burst, now}).first;
  }
  fill(found->second, now);
  return found->second;
}

void RateLimit::fill(Bucket& bucket, Time now) const {
  const double seconds =
      std::chrono::duration<double>(std::max(now - bucket.filled, Time::duration::zero())).count();
  bucket.tokens = std::min(options_.burst, bucket.tokens + seconds * options_.per_second);
  bucket.filled = std::max(bucket.filled, now);
}

/// They are as if they had never been.
void RateLimit::forget_full_ones(Time now) {
  if (now < forget_again_) return;  // it looks at all
  forget_again_ = now + std::chrono::seconds{1};
  std::erase_if(buckets_, [&](auto& each) {
    Bucket bucket = each.second;
    fill(bucket, now);
    return bucket.tokens >= options_.burst;
  });
}

}  // namespace gyrod::monitor
