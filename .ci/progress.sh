# with_progress WHAT COMMAND...: runs a command that may take minutes. Every ten seconds it says how
# far the command is: the last line of its output. Only if the command fails, its output follows,
# whole but for the steps that ninja took.
with_progress() {
  local what=$1 log reporter status=0
  shift
  log=$(mktemp)
  SECONDS=0
  (  # this sleeps, not the command, so that Ctrl-C reaches both; it ends with the caller
    sleeper=
    trap '[ -z "$sleeper" ] || kill "$sleeper"; exit' TERM
    while sleep "${PROGRESS_PERIOD:-10}" >/dev/null 2>&1 & sleeper=$!; wait "$sleeper" && kill -0 "$$" 2>/dev/null; do
      printf '%s, %d s: %s\n' "$what" "$SECONDS" "$(tail -n 1 "$log" | tr -d '\r' | cut -c 1-100)"
    done
  ) &
  reporter=$!
  "$@" >"$log" 2>&1 || status=$?
  kill "$reporter" 2>/dev/null || true
  wait "$reporter" 2>/dev/null || true
  [ "$status" -eq 0 ] || grep -Ev '^\[[0-9]+/[0-9]+\] ' "$log" || true
  rm -f "$log"
  return "$status"
}
