#!/usr/bin/env bash
# Writes every reference part anew by both writers, Open CASCADE and FreeCAD's command line,
# and has the tests of the stored files read these instead.
#
#   live_writers.bash EXCHANGE_TEST SOURCE WORK_FOLDER
set -euo pipefail
exchange_test=$1 source=$2 work=$3

for tool in freecadcmd g++; do
  command -v $tool > /dev/null || { echo "SKIPPED: no $tool"; exit 0; }
done
occt=/usr/include/opencascade
[ -e $occt/STEPControl_Writer.hxx ] || { echo "SKIPPED: no Open CASCADE"; exit 0; }

rm -rf "$work" && mkdir -p "$work/reference/occt"
g++ -std=c++17 -isystem $occt "$source/tests/data/step/write_occt.cpp" \
  -o "$work/write_occt" -lTKSTEP -lTKSTEPAttr -lTKSTEP209 -lTKSTEPBase -lTKXSBase -lTKBO \
  -lTKBool -lTKPrim -lTKTopAlgo -lTKGeomAlgo -lTKBRep -lTKGeomBase -lTKG3d -lTKG2d \
  -lTKMath -lTKernel

for part in "$source"/parts/*.json; do
  name=$(basename "$part" .json)
  "$work/write_occt" "$part" "$work/reference/occt/$name.step" |
    sed -n "s/^volume /$name occt_mm3 /p"
done > "$work/volumes"
freecadcmd -c "
import runpy, sys
sys.argv = ['step_parts.py', '$work/reference/freecad']
runpy.run_path('$source/scripts/step_parts.py', run_name='__main__')" < /dev/null |
  sed -nE 's/^([a-z-]+) ([0-9.e+]+)$/\1 freecad_mm3 \2/p' >> "$work/volumes"

python3 - "$work" <<'END'
import json, pathlib, sys
work = pathlib.Path(sys.argv[1])
volumes = {}
for line in (work / "volumes").read_text().splitlines():
    name, writer, volume = line.split()
    volumes.setdefault(name, {})[writer] = float(volume)
assert volumes and all(len(of) == 2 for of in volumes.values()), volumes
(work / "reference" / "volumes.json").write_text(json.dumps(volumes))
END

TURNWRIGHT_STEP_FILES=$work "$exchange_test" \
  --gtest_filter='Step/Reference.PartsComeBack*/0:Step/Reference.PartsComeBack*/1:Step.VolumesAgree*'
