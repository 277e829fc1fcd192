#!/usr/bin/env bash
# Advisories, licences, bans and sources of all dependencies (deny.toml). What could not be
# checked is said; what was checked and is wrong ends with a failure.
set -euo pipefail
cd "$(dirname "$0")/../.."

if ! cargo deny --version >/dev/null 2>&1; then
    echo "deny: NOT CHECKED: advisories, licences, bans, sources: cargo-deny is not installed (cargo install --locked cargo-deny)"
    exit 0
fi
offline=()
checks=(all)
if ! cargo deny fetch db >/dev/null 2>&1; then
    offline=(--offline)
    database=$(find "${CARGO_HOME:-$HOME/.cargo}/advisory-dbs" -maxdepth 1 -name 'advisory-db-*' 2>/dev/null | head -n 1 || true)
    if [ -n "$database" ]; then
        echo "deny: the advisories cannot be fetched; those of $(git -C "$database" log -1 --format=%cs) are used"
    else
        checks=(licenses bans sources)
        echo "deny: NOT CHECKED: advisories: they cannot be fetched"
    fi
fi
exec cargo deny --locked "${offline[@]}" check --hide-inclusion-graph "${checks[@]}"
