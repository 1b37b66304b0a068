#!/usr/bin/env python3
"""Plans a part over HTTP and prints what it costs and what binds it.

Usage: plan.py PART.json [http://127.0.0.1:8080]
"""
import json
import sys
import urllib.error
import urllib.request

part = open(sys.argv[1], "rb").read()
server = sys.argv[2] if len(sys.argv) > 2 else "http://127.0.0.1:8080"
call = urllib.request.Request(f"{server}/v1/plan", part, {"Content-Type": "application/json"})
try:
    plan = json.load(urllib.request.urlopen(call))
except urllib.error.HTTPError as refused:  # a problem document says what is wrong, and where
    for error in json.load(refused)["errors"]:
        print(f"{error['pointer']}: got {error['got']}, expected {error['expected']}")
    sys.exit(2)
print(f"{plan['status']}: {plan['cost_per_part']} per part, gap {plan['certificate']['gap']:.1e}")
for said in plan["prices"][:3] or plan["conflicts"]:
    print(said["sentence"])
