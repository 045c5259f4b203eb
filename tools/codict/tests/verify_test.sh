#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests codict gen --verify: verify_test.sh CODICT STACK FIXTURES DIRECTORY. DIRECTORY keeps the compiled stack.
set -euo pipefail

codict=$1 stack=$2 fixtures=$3 directory=$4
mkdir -p "$directory"
cd "$directory"
failed=0

# expect STATUS TEXT ARGUMENTS...: runs codict gen and compares its exit status, and its messages with TEXT.
expect() {
  local status=$1 text=$2 got=0
  shift 2
  "$codict" gen "$@" -o generated >out.txt 2>err.txt || got=$?
  if [ "$got" != "$status" ] || ! grep -qF -- "$text" err.txt; then
    echo "not ok: codict gen $*: status $got, expected $status and: $text"
    cat err.txt
    failed=1
  else
    echo "ok: $text"
  fi
}

verify="--verify --stack $stack --build-dir $directory/stack"
small=$fixtures/gen/small.eds

expect 0 'verify: small: CONodeInit() reports no error' "$small" $verify
expect 0 'verify: small: CONodeInit() reports no error' "$small" $verify --language c++

# The configuration is too small for the description.
expect 1 'verify: the description has objects that need USE_PARA, the configuration has USE_PARA = 0: set USE_PARA to 1' \
  "$small" $verify -DUSE_PARA=0
sed -n '1,/^\[1014\]/p' "$small" | sed '$d' >consumers.eds
cat >>consumers.eds <<'EDS'
[1018]
ParameterName=Identity
ObjectType=0x9
SubNumber=2
[1018sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=const
DefaultValue=1
[1018sub1]
ParameterName=Vendor-ID
DataType=0x0007
AccessType=ro
DefaultValue=0
[1016]
ParameterName=Consumers
ObjectType=0x8
CompactSubObj=9
DataType=0x0007
AccessType=rw
EDS
expect 1 'the description has heartbeat consumer 9, the configuration has CO_HBCONS_N = 4: set CO_HBCONS_N to 9' \
  consumers.eds $verify --force -DCO_HBCONS_N=4
expect 0 'CONodeInit() reports no error' consumers.eds $verify --force -DCO_HBCONS_N=9

# The message for an error of the stack has the name of the entry in the description.
cat >remote.eds <<'EDS'
[1000]
ParameterName=Device type
DataType=0x0007
AccessType=ro
DefaultValue=0
[1001]
ParameterName=Error register
DataType=0x0005
AccessType=ro
PDOMapping=1
[1018]
ParameterName=Identity
ObjectType=0x9
SubNumber=2
[1018sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=const
DefaultValue=1
[1018sub1]
ParameterName=Vendor-ID
DataType=0x0007
AccessType=ro
DefaultValue=0
EDS
for number in 0 1; do
  cat >>remote.eds <<EDS
[180$number]
ParameterName=Remote $number
ObjectType=0x9
SubNumber=3
[180${number}sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=const
DefaultValue=2
[180${number}sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=\$NODEID+0x18$number
[180${number}sub2]
ParameterName=Transmission type
DataType=0x0005
AccessType=rw
DefaultValue=253
[1A0$number]
ParameterName=Mapping
ObjectType=0x9
SubNumber=2
[1A0${number}sub0]
ParameterName=Number
DataType=0x0005
AccessType=rw
DefaultValue=1
[1A0${number}sub1]
ParameterName=Object
DataType=0x0007
AccessType=rw
DefaultValue=0x10010008
EDS
done
remote="remote.eds $verify --force -DUSE_PDO_RTR=0"
expect 1 'verify: remote: 1800h sub 2 (Remote 0 Transmission type): a TPDO is off' $remote
expect 1 'verify: remote: 1801h sub 2 (Remote 1 Transmission type): a TPDO is off' $remote
expect 1 '[CO_ERR_TPDO_COM_OBJ]' $remote

exit $failed
