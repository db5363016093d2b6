# shellcheck shell=bash
# What the scripts beside it share that write parts of a page: they say which $page, and where $results may lie.

# For jq: numbers with three digits.
short='def short: if . == null then "–" elif . == 0 then "0" else
  (. as $x | ($x | fabs | log10 | floor) as $e | pow(10; 2 - $e) as $k | ($x * $k | round) / $k | tostring) end;'

# Fails unless the page has a line <!-- begin NAME -->.
require_part() {
  grep -q "^<!-- begin $1 -->\$" "$page" || { echo "$(basename "$0"): $page has no part for $1" >&2 && exit 1; }
}

# Puts a file between the page's lines <!-- begin NAME --> and <!-- end NAME -->.
insert() {
  require_part "$1"
  awk -v file="$2" -v begin="<!-- begin $1 -->" -v end="<!-- end $1 -->" '
    $0 == begin { print; while ((getline line < file) > 0) print line; inside = 1 }
    $0 == end { inside = 0 }
    !inside { print }' "$page" >"$results/page"
  cp "$results/page" "$page"
}
