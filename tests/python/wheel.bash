# Makes the wheel from the build as it is and installs it into a fresh environment, without
# network.  Usage: wheel.bash PYTHON_SOURCES BUILD_FOLDER WORK_FOLDER
set -euo pipefail
sources=$1 build=$2 work=$3

python3=/usr/bin/python3 # Debian's, for which scripts/setup installs
$python3 -c 'import pip, venv' 2> /dev/null || {
  echo 'SKIPPED: NOT CHECKED: no pip or venv for python3 (scripts/setup --python)'
  exit 0
}
rm -rf "$work"
mkdir -p "$work"
cp -r "$sources" "$work/sources"
export TURNWRIGHT_BUILD=$build PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore
cd "$work"
$python3 -m pip wheel --quiet --no-index --no-deps -w . ./sources
$python3 -m venv --without-pip --system-site-packages environment
$python3 -m pip --quiet --python environment/bin/python install --no-index --no-deps turnwright-*.whl
ls turnwright-*.whl
