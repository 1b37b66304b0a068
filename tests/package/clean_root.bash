# Installs the .deb with apt into a fresh Debian 12; plans and serves there as a user
# without rights, from a folder of his own; removes it, and compares the root with what it
# was before.  Then installs it with the libraries' packages and builds the examples.
# Usage: clean_root.bash BUILD_FOLDER WORK_FOLDER PART.json EXAMPLES
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin
build=$1 work=$2 part=$3 examples=$4
mirror=http://deb.debian.org/debian

skip() { echo "SKIPPED: NOT CHECKED in a clean root: $1"; exit 0; }
[[ $(id -u) == 0 ]] || skip "needs root"
for tool in debootstrap dpkg-shlibdeps unshare; do
  command -v "$tool" > /dev/null || skip "no $tool"
done

rm -rf "$work"
mkdir -p "$work"
root=$work/root
cpack --config "$build/CPackConfig.cmake" -B "$work/deb" > "$work/log" 2>&1
debootstrap --variant=minbase bookworm "$root" "$mirror" >> "$work/log" 2>&1 ||
  skip "no Debian from $mirror: $(tail -n 1 "$work/log")"
cp -r "$work"/deb/*.deb "$part" "$examples" "$root/root/"
cp /etc/resolv.conf "$root/etc/"

inside() { # in a mount namespace of its own with /proc
  unshare --mount sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"' "$root" \
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@" >> "$work/log" 2>&1 ||
    { tail -n 30 "$work/log"; echo "failed: $*"; exit 1; }
}
files() { # but for apt's and dpkg's own notes
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./tmp -o -path ./root -o -path ./var/log \
    -o -path ./var/lib/apt -o -path ./var/lib/dpkg -o -path ./var/cache \
    -o -name ld.so.cache \) -prune -o -print | sort)
}

inside apt-get update
files > "$work/before"
inside sh -c 'apt-get install -y --no-install-recommends /root/turnwright_*.deb'
inside sh -c "mkdir -p '/tmp/a folder' && cp /root/*.json '/tmp/a folder/part.json' &&
  chown -R nobody '/tmp/a folder'"
cat > "$root/tmp/use" <<'USE'
set -e
cd '/tmp/a folder'
turnwright --version
turnwright plan part.json -o plan.json --report plan.html --drawings d --nc nc
grep -q '"status": "ok"' plan.json && grep -q '<h1>' plan.html && ls nc/setup-1.ngc d/setup-1.svg
turnwright list machines | grep lathe-medium
HOME=$PWD turnwright serve --port 0 > said 2> log &
while ! grep http said; do kill -0 $!; sleep 0.1; done
exec 3<> /dev/tcp/127.0.0.1/$(sed 's|.*:\([0-9]*\)/|\1|' said)
printf 'GET /readyz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n' >&3
grep ready <&3
kill -TERM $!
wait $!
USE
inside setpriv --reuid=nobody --regid=nogroup --clear-groups bash /tmp/use
inside test -f /lib/systemd/system/turnwright.service
inside sh -c 'apt-get purge -y --autoremove turnwright'
files > "$work/after"
diff "$work/before" "$work/after" || { echo "left behind or lost"; exit 1; }

inside sh -c 'apt-get install -y --no-install-recommends /root/*.deb g++ cmake make pkg-config'
inside sh -c 'cmake -S /root/examples -B /tmp/examples && cmake --build /tmp/examples &&
  /tmp/examples/planning /root/*.json | grep per.part'
inside sh -c 'cd /tmp && cc /root/examples/answer.c $(pkg-config --cflags --libs turnwright) -o answer &&
  ldd ./answer && echo "{}" | ./answer plan | grep pointer'
rm -rf "$root"
echo "clean root: installed, used, removed without a trace; examples built with the libraries"
