#!/usr/bin/env python3
"""Hostile and honest calls, mixed, to a server that may have 800 MB.

    tests/service/attacks.py TURNWRIGHT SOURCE_FOLDER [HOSTILE HONEST]

Every honest call must be answered (after 503 it is sent again), every hostile one answered
or refused, and the server's memory must be flat over a thousand calls.  Ends with 1 if that is not so.
"""
import collections
import json
import os
import random
import re
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

LIMIT = 800 * 1024 * 1024  # bytes of address space
CALLERS = 24
PATIENCE = 120  # seconds; a loaded machine is no fault
JUDGED = 1000  # calls; in fewer the memory shows when the large bodies came
KEPT_OPEN = 40  # slow connections at a time


def head(path, length=None, kind="application/json", more=""):
    size = "Transfer-Encoding: chunked" if length is None else f"Content-Length: {length}"
    return (f"POST {path} HTTP/1.1\r\nHost: x\r\nContent-Type: {kind}\r\n{size}\r\n"
            f"{more}\r\n").encode()


def call(path, body, more="Connection: close\r\n"):
    return head(path, len(body), more=more) + body


def repeated(piece, size):
    return (piece * (size // len(piece) + 1))[:size]


def nested(depth):
    return b"[" * depth + b"]" * depth


LINE = b'{"name": "multipass", "document": {"x": "' + b"a" * 50_000 + b'"}}\n'
LARGE = 1_900_000
SLOW_SPEED = json.dumps({
    "model": "milling", "teeth": 3, "Kt_MPa": 700, "Kn_MPa": 250, "direction": "up",
    "radial_immersion": 0.4, "method": "simulation", "modes": [
        {"axis": "x", "frequency_Hz": 900, "damping_ratio": 0.02, "stiffness_N_mm": 9000}],
    "ap_max_mm": 4, "speeds_rpm": [200]}).encode()
MANY_DRAWS = json.dumps({"cases": [{
    "tolerance": "diameter", "e_mm": [0.001], "upper_mm": 0.1, "lower_mm": -0.1,
    "budget": {"draws": 10_000_000, "sources": [
        {"name": str(i), "distribution": "normal", "value_um": 1} for i in range(90)]}}
]}).encode()

# What is sent, and whether the caller stays for an answer.
HOSTILE = [
    ("half a body", head("/v1/plan", 2_000_000) + b" " * LARGE, "stays"),
    ("blanks", call("/v1/plan", b" " * LARGE), "answer"),
    ("lists", call("/v1/plan", b"[" + b"[]," * (LARGE // 3) + b"0]"), "answer"),
    ("zeros", call("/v1/multipass", b'{"dt_mm": [' + b"0," * (LARGE // 2) + b"0]}"), "answer"),
    ("keys", call("/v1/plan", b"{" + b",".join(b'"%d":0' % i for i in range(150_000)) + b"}"),
     "answer"),
    ("depth", call("/v1/plan", nested(900_000)), "answer"),
    ("no chunk", head("/v1/plan") + b"0x\r\n", "answer"),
    ("chunk of 2^64", head("/v1/plan") + b"ffffffffffffffff\r\n", "answer"),
    ("small chunks", head("/v1/plan") + b"1\r\n \r\n" * 300_000 + b"0\r\n\r\n", "answer"),
    ("extensions", head("/v1/plan") + b"1;" + b"a" * LARGE, "answer"),
    ("trailers", head("/v1/plan") + b"0\r\n" + b"a: b\r\n" * 300_000, "answer"),
    ("fields", b"GET /healthz HTTP/1.1\r\nHost: x\r\n" + b"a:\r\n" * 4000 + b"\r\n", "answer"),
    ("long field", b"GET /healthz HTTP/1.1\r\nHost: x\r\na: " + b"a" * LARGE, "answer"),
    ("no HTTP", bytes(range(256)) * 4000, "answer"),
    ("half a header", b"GET /healthz HTTP/1.1\r\nHost: x\r\n" + b"a: b\r\n" * 90, "stays"),
    ("a batch of no JSON", head("/v1/batches", 20_000_000, "application/jsonl")
     + repeated(b"no json\n", 300_000), "leaves"),
    ("half a large batch", head("/v1/batches", 250_000_000, "application/jsonl")
     + LINE * 200, "stays"),
    ("a slow speed", call("/v1/stability", SLOW_SPEED), "leaves"),
    ("many draws", call("/v1/acceptance", MANY_DRAWS), "leaves"),
    ("pages unread", b"GET /openapi.json HTTP/1.1\r\nHost: x\r\n\r\n" * 50, "stays"),
]
HONEST = [
    (call("/v1/multipass", b"{}"), 200),
    (call("/v1/multipass", b" " * 200_000 + b"{}"), 200),
    (b"GET /v1/parts/pump-shaft HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", 200),
    (b"GET /openapi.json HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", 200),
    (head("/v1/batches", None, "application/jsonl", "Connection: close\r\n")
     + b'2f\r\n{"name": "multipass", "document": {"dt_mm": 8}}\r\n0\r\n\r\n', 202),
]

port = 0
answers = collections.Counter()
wrong = []
open_slow = collections.deque()
lock = threading.Lock()


def status(connection):
    answer = b""
    while b"\r\n" not in answer:
        more = connection.recv(4096)
        if not more:
            return 0
        answer += more
    code = int(answer[9:12])
    while connection.recv(65536):
        pass
    return code


def connect():
    connection = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
    return connection


def attack(kind):
    name, sent, then = kind
    try:
        connection = connect()
        try:
            connection.sendall(sent)
        except (ConnectionError, BrokenPipeError):
            pass  # refused before its end
        if then == "answer":
            code = status(connection)
            with lock:
                answers[f"{name}: {code}"] += 1
                if code in (0, 200, 500, 408, 504):
                    wrong.append(f"{name}: {code}")
            connection.close()
        elif then == "stays":
            with lock:
                open_slow.append(connection)
                leaving = open_slow.popleft() if len(open_slow) > KEPT_OPEN else None
            if leaving:
                leaving.close()
        else:
            time.sleep(0.05)
            connection.close()
    except ConnectionError:  # cut while it was still sending
        with lock:
            answers[f"{name}: cut"] += 1
    except OSError as error:
        with lock:
            wrong.append(f"{name}: {error!r}")


def ask(kind):
    sent, expected = kind
    begun = time.monotonic()
    while True:
        try:
            connection = connect()
            connection.sendall(sent)
            code = status(connection)
            connection.close()
        except OSError as error:
            code = repr(error)
        if code != 503 or time.monotonic() - begun > PATIENCE:
            break
        time.sleep(0.2)
    with lock:
        answers[f"honest: {code}"] += 1
        if code != expected:
            wrong.append(f"honest {sent[:40]}: {code}")


def memory_MB(pid, key):
    with open(f"/proc/{pid}/status") as file:
        return int(re.search(key + r":\s+(\d+)", file.read()).group(1)) / 1024


def mixed(hostile, honest):
    order = [(attack, HOSTILE[i % len(HOSTILE)]) for i in range(hostile)]
    order += [(ask, HONEST[i % len(HONEST)]) for i in range(honest)]
    random.Random(2026).shuffle(order)
    return collections.deque(order)


def run(pid, calls):
    """Returns the memory after each eighth of the calls."""
    total, seen = len(calls), []

    def caller():
        while True:
            with lock:
                if not calls:
                    return
                act, kind = calls.popleft()
                if 8 * (total - len(calls)) // total > len(seen):
                    seen.append(memory_MB(pid, "VmRSS"))
            act(kind)

    callers = [threading.Thread(target=caller) for _ in range(CALLERS)]
    for one in callers:
        one.start()
    for one in callers:
        one.join()
    return seen


def main():
    global port
    program, source = sys.argv[1:3]
    hostile, honest = map(int, sys.argv[3:5] or (200, 200))
    with tempfile.TemporaryDirectory() as folder:
        server = subprocess.Popen(
            [program, "--data", source, "serve", "--port", "0", "--threads", "2",
             "--jobs", os.path.join(folder, "jobs.sqlite")],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT)))
        try:
            port = int(re.search(r":(\d+)/", server.stdout.readline()).group(1))
            begun = time.monotonic()
            seen = run(server.pid, mixed(hostile, honest))
            took = time.monotonic() - begun
            if server.poll() is not None:
                wrong.append(f"the server ended with {server.returncode}")
            else:
                print(f"{hostile} hostile and {honest} honest calls in {took:.0f} s; "
                      f"memory {', '.join(f'{m:.0f}' for m in seen)} MB, at most "
                      f"{memory_MB(server.pid, 'VmHWM'):.0f} MB, address space at most "
                      f"{memory_MB(server.pid, 'VmPeak'):.0f} MB")
                enough = hostile + honest >= JUDGED
                if enough and max(seen[4:]) > 1.3 * max(seen[:4]) + 30:
                    wrong.append("memory grows")
                for connection in open_slow:
                    connection.close()
                server.send_signal(signal.SIGTERM)
                if server.wait(PATIENCE) != 0:
                    wrong.append(f"the server ended with {server.returncode}")
        finally:
            server.kill()
            server.wait()
    for what, count in sorted(answers.items()):
        print(f"{count:6} {what}")
    for what in wrong[:20]:
        print("WRONG", what)
    sys.exit(1 if wrong else 0)


main()
