#!/bin/sh
# Plans a part over HTTP; its report goes to report.html, its cost to the terminal.
# Usage: plan.sh PART.json [http://127.0.0.1:8080]
set -eu
part=$1
server=${2:-http://127.0.0.1:8080}
json='Content-Type: application/json'
curl -sf "$server/v1/parts" | grep '"id"' | head -n 3
curl -sf -H "$json" --data-binary "@$part" "$server/v1/plan/report" -o report.html
curl -sf -H "$json" --data-binary "@$part" "$server/v1/plan" | grep '"cost_per_part"'
