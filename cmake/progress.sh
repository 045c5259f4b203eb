# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# with_progress WHAT LOG COMMAND...
#
# Runs COMMAND with its output in LOG. After a second it shows the progress on standard error: on a terminal in one line
# that is rewritten every second and erased at the end, otherwise in a new line every 15 seconds. Returns the status of
# COMMAND.

progress_of_log() {  # LOG: "12 of 89" of a build with ninja, otherwise the last line
  tail -n 1 "$1" | sed -E 's/^\[([0-9]+)\/([0-9]+)\] .*/\1 of \2/' | tr -d '\r' | cut -c 1-60
}

watch_log() {  # WHAT LOG PID: until the process has ended
  local begin=$SECONDS
  # The last sleep may outlive with_progress: it must not keep a pipe open that the caller reads.
  while sleep 1 >/dev/null 2>&1 && kill -0 "$3" 2>/dev/null; do
    if [ -t 2 ]; then
      printf '\r\033[K%s: %d s, %s' "$1" $((SECONDS - begin)) "$(progress_of_log "$2")" >&2
    elif [ $(((SECONDS - begin) % 15)) -eq 0 ]; then
      printf '%s: %d s, %s\n' "$1" $((SECONDS - begin)) "$(progress_of_log "$2")" >&2
    fi
  done
}

with_progress() {
  local what=$1 log=$2 status=0 watcher
  shift 2
  : >"$log"
  watch_log "$what" "$log" $BASHPID &
  watcher=$!
  "$@" >"$log" 2>&1 || status=$?
  kill "$watcher" 2>/dev/null
  wait "$watcher" 2>/dev/null || true
  [ ! -t 2 ] || printf '\r\033[K' >&2
  return $status
}
