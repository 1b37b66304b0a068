# Packs the build twice, as reproducible-builds.org has it, and compares every byte.
# Usage: reproducible.bash BUILD_FOLDER WORK_FOLDER
set -euo pipefail
command -v dpkg-shlibdeps > /dev/null || { echo 'SKIPPED: NOT CHECKED: no dpkg-dev'; exit 0; }
rm -rf "$2"
export SOURCE_DATE_EPOCH=1700000000
for time in first second; do
  cpack --config "$1/CPackConfig.cmake" -B "$2/$time" > "$2.log" 2>&1 || { cat "$2.log"; exit 1; }
  sleep 2 # another second, and other times of what is packed
done
for deb in "$2"/first/turnwright_*.deb; do
  cmp "$deb" "$2/second/$(basename "$deb")"
  sha256sum "$deb"
done
