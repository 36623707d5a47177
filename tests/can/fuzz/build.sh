#!/bin/sh
# Builds a libFuzzer harness with clang, AddressSanitizer and UndefinedBehaviorSanitizer:
# build.sh codec|nodes OUTPUT
set -eu
root="$(cd "$(dirname "$0")/../../.." && pwd)"
clang="${CLANG:-$(command -v clang || command -v clang-14)}"
exec "$clang" -std=c11 -O2 -g1 -ffp-contract=off -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
  -I"$root/firmware" -I"$root/firmware/include" "$root/tests/can/fuzz/fuzz_$1.c" "$root"/firmware/can/*.c \
  "$root"/firmware/can/generated/*.c -o "$2"
