# Makes the site and looks something up in it as in a folder of files.
# Usage: site.bash SCRIPT WORK_FOLDER
set -euo pipefail
for tool in mkdocs doxygen; do
  command -v $tool > /dev/null || { echo "SKIPPED: NOT CHECKED: no $tool (scripts/setup --site)"; exit 0; }
done
"$1" "$2"
for page in docs/guide.html schemas/part.html api/annotated.html; do
  [[ -s $2/$page ]] || { echo "no $page"; exit 1; }
done
command -v chromium > /dev/null || { echo 'search NOT CHECKED: no chromium'; exit 0; }
found=$(chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=20000 --dump-dom \
  "file://$2/docs/guide.html?q=cowper" 2> /dev/null)
[[ $found == *'id="mkdocs-search-results"'*'href="../docs/bibliography.html'* ]] ||
  { echo "search finds no Cowper in the bibliography"; exit 1; }
