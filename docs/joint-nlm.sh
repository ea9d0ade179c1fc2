#!/usr/bin/env bash
# Prints what the parts of joint-nlm are worth: relMSE of each variant over that of the defaults, geometric mean over the tuning
# scenes at 192x144 with 16 and 64 samples, one seed. Takes a few minutes.
# Usage: docs/joint-nlm.sh [FOLDER for the frames]; `limpid` is on the path.
set -euo pipefail
cd "$(dirname "$0")/.."
work="${1:-$(mktemp -d)}"
mkdir -p "$work"
frames=()
for scene in corner court shelf; do
    file="scenes/tune/$scene/scene.xml"
    [ -s "$work/$scene.exr" ] || limpid render "$file" --size 192x144 --spp 1024 --seed 9 -o "$work/$scene.exr" --quiet
    for spp in 16 64; do
        [ -s "$work/$scene-$spp.exr" ] ||
            limpid render "$file" --size 192x144 --spp "$spp" --layers all -o "$work/$scene-$spp.exr" --quiet
        frames+=("$scene $spp")
    done
done

# The errors of all frames under the given `--set` options, a line each.
errors() {
    for frame in "${frames[@]}"; do
        read -r scene spp <<<"$frame"
        limpid denoise "$work/$scene-$spp.exr" --method joint-nlm "$@" -o "$work/out.exr" --quiet
        limpid metrics "$work/out.exr" "$work/$scene.exr" --json | sed -E 's/.*"relmse":([^,}]*).*/\1/'
    done
}

errors >"$work/default.txt"
while read -r options; do
    # shellcheck disable=SC2086 # the options are words
    errors $options | paste - "$work/default.txt" |
        awk -v name="$options" '{ sum += log($1 / $2) } END { printf "%-60s %.2f\n", name, exp(sum / NR) }'
done <<'VARIANTS'
--set second_radius=0
--set second_radius=0 --set patch=1
--set second_radius=0 --set k_color=100 --set tau=1e-4
--set sigma_spatial=1000000
VARIANTS
