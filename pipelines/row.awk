# A line of what wp-metrics found, for people: awk -F, -f row.awk run=NAME wp.csv
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
{ wp[$at["side"]] = $at["wp_um"]; ep = $at["ep_um"] }
END { printf "%-30s WP %5.2f um (bottom %.2f, top %.2f), EP %.2f um\n", run, wp["total"], wp["bottom"], wp["top"], ep }
