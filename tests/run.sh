#!/usr/bin/env bash
# Installs what is needed, builds, and runs every test. Needs nothing but a Debian 12 and this clone.
#
#   bash tests/run.sh                 all stages, as the continuous integration does
#   bash tests/run.sh release asan    only these stages
#
# Stages: format release asan tsan demo tidy; and analyze (clang's static analyzer), by name alone, as it takes long.
# Real recordings are looked for in GYROD_DATA (default ../shared/data); tests that want one say so and skip where it is absent.
set -euo pipefail
cd "$(dirname "$0")/.."

stages=("$@")
if [ ${#stages[@]} -eq 0 ]; then stages=(format release asan tsan demo tidy); fi
jobs=$(nproc)

export GYROD_DATA="${GYROD_DATA:-$PWD/../shared/data}"
export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1"
export UBSAN_OPTIONS="print_stacktrace=1"
export TSAN_OPTIONS="suppressions=$PWD/tests/support/tsan.supp:halt_on_error=1"

our_sources() { git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp'; }

stage_format() { our_sources | xargs clang-format --dry-run --Werror; }

# For clang-tidy, in build/tidy: sources with the flags of dev, several at a time or each alone (ON or OFF: a unity build).
configure_tidy() {
  cmake --preset dev -B build/tidy -DGYROD_BUILD_TESTS=OFF -DCMAKE_UNITY_BUILD="$1" -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 >/dev/null
  # Of what is generated, they include the bus types alone.
  cmake --build build/tidy --target gyrod_idl >/dev/null
  # Options of GCC that clang does not know. Clang sees deprecated declarations inside the standard library; GCC warns of ours.
  sed -i -E 's/-Wno-restrict|-Wno-maybe-uninitialized|-Wno-subobject-linkage//g; s/ -Werror/ -Werror -Wno-deprecated-declarations/' build/tidy/compile_commands.json
}
tidy_sources() { sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' build/tidy/compile_commands.json | grep -E "^$PWD/service/|/service/.*/Unity/" | sort -u; }

# All but the analyzer, which takes a source that is included for a header.
stage_tidy() {
  configure_tidy ON
  tidy_sources | xargs -P "$jobs" -n 1 clang-tidy-22 --quiet -p build/tidy '--checks=-clang-analyzer-*,-bugprone-suspicious-include' 2>/dev/null
}

stage_analyze() {
  configure_tidy OFF
  tidy_sources | xargs -P "$jobs" -n 1 clang-tidy-22 --quiet -p build/tidy '--checks=-*,clang-analyzer-*' 2>/dev/null
}

# Tests with real daemons, with participants of DDS or slow clients live in real time: a busy machine that leaves one of them without a processor for seconds
# fails it. One that failed beside others is run once more, alone, and has to pass there. What does not depend on time gets no second chance, nor does
# what a sanitizer reported.
again_alone() {
  local results=build/$1/Testing/Temporary failed timed
  if grep -qE '(ERROR|WARNING): [A-Za-z]+Sanitizer|runtime error:' "$results/LastTest.log"; then return 1; fi
  failed=$(cut -d: -f2 "$results/LastTestsFailed.log")
  timed=$(ctest --preset "$1" -N -L "$timed_labels" | sed -n 's/^ *Test *#[0-9]*: //p')
  if grep -qvxF "$timed" <<<"$failed"; then return 1; fi
  printf '== failed beside other tests, so once more, alone:\n%s\n' "$failed"
  ctest --preset "$1" --rerun-failed -j 1
}
timed_labels='^(integration|browser|fleet|timed)$'

build_and_test() {
  cmake --preset "$1"
  cmake --build --preset "$1" -j "$jobs"
  ctest --preset "$1" -j "$2" --no-tests=error || again_alone "$1"
}
# Many tests wait more than they compute; with the thread sanitizer they compute.
stage_release() { build_and_test release $((2 * jobs)); }
stage_asan() { build_and_test asan $((2 * jobs)); }
stage_tsan() { build_and_test tsan $((jobs + 1)); }

stage_demo() { bash deploy/demo.sh --seconds 8; }

# Tests wait more than they compute: where others run, too, tidy fills that time, at the lowest priority.
tidy_beside=
begin_tidy_beside() {
  mkdir -p build
  set -m # a process group of its own, to end all of it
  (
    renice -n 19 -p "$BASHPID" >/dev/null
    stage_tidy
  ) >build/tidy.log 2>&1 &
  tidy_beside=$!
  set +m
  trap 'kill -- "-$tidy_beside" 2>/dev/null || true' EXIT
}
end_tidy_beside() {
  local passed=0
  wait "$tidy_beside" || passed=$?
  trap - EXIT
  cat build/tidy.log
  return "$passed"
}

bash deploy/install-packages.sh
if [[ ${#stages[@]} -gt 1 && " ${stages[*]} " == *" tidy "* ]]; then begin_tidy_beside; fi
for stage in "${stages[@]}"; do
  echo "== $stage"
  begin=$SECONDS
  if [[ $stage == tidy && -n $tidy_beside ]]; then
    end_tidy_beside
  else
    "stage_$stage"
  fi
  echo "== $stage passed in $((SECONDS - begin)) s"
done
echo "all stages passed: ${stages[*]}"
