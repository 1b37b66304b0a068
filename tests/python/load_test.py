"""Many calls: their speed with one thread and with all, and the memory they leave behind."""
import os
import time
from concurrent.futures import ThreadPoolExecutor

import turnwright

LEAK_CALLS, LEAK_BYTES = 100_000, 4_000_000
REQUEST = turnwright.example("deflection")


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def seconds(threads, work, calls):
    begun = time.perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        for _ in pool.map(lambda _: work(), range(calls)):
            pass
    return time.perf_counter() - begun


def speed_up():
    cores, shaft = os.cpu_count(), REQUEST | {"positions_mm": [0.1 * i for i in range(1500)]}
    pin = turnwright.example("plan")
    for name, calls, work in (
            ("plan of a pin", 10_000, lambda: turnwright.plan(pin)),
            ("deflection, 2 positions", 10_000, lambda: turnwright.deflection(REQUEST)),
            ("deflection, 1500 positions", 1000, lambda: turnwright.deflection(shaft))):
        one, all_ = seconds(1, work, calls // 10) / (calls // 10), seconds(cores, work, calls) / calls
        print(f"{name}: {1e3 * one:.2f} ms a call, speed-up {one / all_:.2f} with {cores} threads")


def leak():
    for _ in range(2000):
        turnwright.deflection(REQUEST)
    before = resident_bytes()
    for i in range(LEAK_CALLS):
        try:
            turnwright.deflection(REQUEST if i % 2 else {"shaft": i})
        except turnwright.InputError:
            pass
    grown = resident_bytes() - before
    print(f"{LEAK_CALLS} calls, half of them wrong: {grown / 1e6:.2f} MB more")
    assert grown < LEAK_BYTES, grown


if __name__ == "__main__":
    speed_up()
    leak()
