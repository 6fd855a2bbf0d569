#!/usr/bin/env bash
# Daemons killed, paused and stopped at random moments, many times: tests/integration/chaos_test.cpp with one seed after the other.
#
#   bash tests/benchmark/chaos_study.sh build/release [RUNS [SECONDS [FIRST_SEED [FILTER]]]]
#
# RUNS (5) times each case whose name fits FILTER (all), for SECONDS (60) of blows each, from FIRST_SEED (1) on. Prints what came twice at
# the most after each kind of blow; of a run that fails, its log. Exit code 1 if any did. Uses the loopback network.
set -euo pipefail

folder=${1:?build folder}
runs=${2:-5}
seconds=${3:-60}
first=${4:-1}
filter=${5:-*}

export GYROD_BINARY GYROD_TEST_SLOT=${GYROD_TEST_SLOT:-34}
GYROD_BINARY=$(realpath "$folder/gyrod")
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed=0
for ((seed = first; seed < first + runs; ++seed)); do
  if ! GYROD_CHAOS_SEED=$seed GYROD_CHAOS_SECONDS=$seconds \
    "$folder/chaos_test" --gtest_filter="$filter" > "$log" 2>&1; then
    failed=$((failed + 1))
    cat "$log"
  fi
  grep '^chaos' "$log" || true
done
echo "$runs runs, $failed of them failed"
[[ $failed == 0 ]]
