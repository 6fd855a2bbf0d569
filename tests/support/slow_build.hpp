/// Whether a sanitizer makes this build several times slower.
#pragma once

namespace gyrod::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSlowBuild = true;
#else
inline constexpr bool kSlowBuild = false;
#endif

}  // namespace gyrod::testing
