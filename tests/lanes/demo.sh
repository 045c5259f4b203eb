# SPDX-License-Identifier: Apache-2.0
about="demo/run: builds the demo, shows it and serves it on a hub; the commands of docs/demo.md"
minutes=2
packages=(g++ cmake ninja-build=ninja "${tool_packages[@]}" python3 chromium)

lane() {
  export CFLAGS=-Werror CXXFLAGS=-Werror
  now_in "$build/demo/build.log"
  run_pages "$root"
  rm -f "$root"/recorder.{csv,html}
  check "demo/run --virtual" shows "steps in .* all as expected" --virtual
  check "docs/pictures shows this output" same_screen
  check "demo/run thermometer" shows "TPDO1 temperature in 0.1 degrees Celsius = 1010" thermometer
  check "demo/run srdo" shows "the motor was off [0-9.]+ ms after the fault" srdo
  check "demo/run recorder, and its picture in Chromium" drawn
  check "demo/run --serve, and the commands for the master" served
  check "demo/run --serve without node-ID, and lss set-id" configured
}

demo() { "$root/demo/run" "$@"; }

shows() {  # REGEX ARGUMENT...
  demo "${@:2}" | tee "$results/demo-shown.log" | grep -E "$1"
}

same_screen() {
  "$root/docs/site/screens.py" "$results" && diff "$results/screen_demo.svg" "$root/docs/pictures/screen_demo.svg"
}

drawn() {
  rm -f "$results"/recorder.{csv,html}
  demo recorder --output "$results/recorder.csv" &&
    python3 "$root/tests/programs/demo/picture.py" "$results/recorder.html" "$results/recorder.png"
}

# Waits minutes for a line of the node, for a busy machine, but not for a node that has ended: await REGEX
await() {
  local tries=6000
  until grep -qE "$1" "$log" || [ $((tries -= 1)) -eq 0 ] || ! kill -0 "$node"; do sleep 0.1; done
  grep -qE "$1" "$log"
}

# Runs COMMAND while the node serves: with_node COMMAND NODE-ARGUMENT...
with_node() (
  log=$results/demo-serve.log
  : >"$log"  # await must not see the lines of the previous node
  "$root/demo/run" --serve -i hub:lane-demo "${@:2}" >"$log" 2>&1 &
  node=$!
  trap 'kill "$node"; wait "$node"; cat "$log"' EXIT
  await '^ *time/s' && "$1"
)

read_and_command() {
  local master=(demo master -i hub:lane-demo --timeout 600000)
  [ "$("${master[@]}" --node 5 --index 1008 read)" = "Lexican demo clock" ] &&
    "${master[@]}" --node 5 --index 2100 --sub 1 --type u8 write 12 &&
    [ "$("${master[@]}" --node 5 --index 2100 --sub 1 read)" = 0x0C ] &&
    "${master[@]}" --node 5 nmt start
}

served() { with_node read_and_command --node-id 5; }

# Selects the node by its address, for the reason given in tests/programs/demo/serve.sh.
give_node_id() {
  local master=(demo master -i hub:lane-demo --timeout 600000)
  "${master[@]}" lss --address 0 0xC10C 1 7 set-id 5 --store && await '705 +00 .*boot-up' &&
    [ "$("${master[@]}" --node 5 --index 1008 read)" = "Lexican demo clock" ]
}

configured() {
  rm -f "$results/clock.nvm"
  with_node give_node_id --node-id unconfigured --serial 7 --storage "$results/clock.nvm"
}
