// SPDX-License-Identifier: Apache-2.0
// Access to variables: lookup, extensions, and reading and writing of whole values (co_od.h).
#include "dictionary/dict.hpp"
#include "extra/od/index.hpp"
#include "extra/od/properties.hpp"
#include "extra/od/transfer.hpp"

#if USE_OD

namespace co::od {
namespace {

ODR_t no_read(OD_stream_t*, void*, OD_size_t, OD_size_t*) { return ODR_UNSUPP_ACCESS; }
ODR_t no_write(OD_stream_t*, const void*, OD_size_t, OD_size_t*) { return ODR_UNSUPP_ACCESS; }

void describe_variable(OD_stream_t& stream, void* memory, OD_attr_t attribute, OD_size_t length) {
  stream.dataOrig = memory;
  stream.attribute = attribute;
  stream.dataLength = length;
}

ODR_t describe_array(const OD_entry_t& entry, uint8_t sub, OD_stream_t& stream) {
  const auto& array = *static_cast<const OD_obj_array_t*>(entry.odObject);
  if (sub >= entry.subEntriesCount) {
    return ODR_SUB_NOT_EXIST;
  }
  if (sub == 0) {
    describe_variable(stream, array.dataOrig0, array.attribute0, 1);
    return ODR_OK;
  }
  auto* const first = static_cast<uint8_t*>(array.dataOrig);
  const size_t distance = size_t{array.dataElementSizeof} * (sub - 1U);
  describe_variable(stream, first == nullptr ? nullptr : first + distance, array.attribute, array.dataElementLength);
  return ODR_OK;
}

ODR_t describe_record(const OD_entry_t& entry, uint8_t sub, OD_stream_t& stream) {
  const auto* const record = static_cast<const OD_obj_record_t*>(entry.odObject);
  unsigned position = 0;
  while (position < entry.subEntriesCount && record[position].subIndex != sub) {
    ++position;
  }
  if (position == entry.subEntriesCount) {
    return ODR_SUB_NOT_EXIST;
  }
  describe_variable(stream, record[position].dataOrig, record[position].attribute, record[position].dataLength);
  return ODR_OK;
}

// Describes a variable of an object that is not in a table: its memory.
ODR_t describe_memory(const OD_entry_t& entry, uint8_t sub, OD_stream_t& stream) {
  switch (entry.odObjectType & ODT_TYPE_MASK) {
    case ODT_VAR: {
      const auto& variable = *static_cast<const OD_obj_var_t*>(entry.odObject);
      describe_variable(stream, variable.dataOrig, variable.attribute, variable.dataLength);
      return sub == 0 ? ODR_OK : ODR_SUB_NOT_EXIST;
    }
    case ODT_ARR: return describe_array(entry, sub, stream);
    case ODT_REC: return describe_record(entry, sub, stream);
    default: return ODR_DEV_INCOMPAT;
  }
}

// Describes a variable of an object, for an access from its beginning.
ODR_t describe(const OD_entry_t& entry, uint8_t sub, OD_stream_t& stream) {
  if (!is_of_table(entry)) {
    stream = {};
    stream.index = entry.index;
    stream.subIndex = sub;
    return describe_memory(entry, sub, stream);
  }
  CO_OBJ* const obj = find_in_table(entry, sub);
  if (obj == nullptr) {
    return ODR_SUB_NOT_EXIST;
  }
  stream = stream_of(*obj, *owner_of(entry).Node);
  return ODR_OK;
}

// Returns whether an extension serves the variable. If the type of its entry is not extensible, the extension is
// ignored, as it is for SDO and PDO.
bool is_extended(const OD_entry_t& entry, const OD_stream_t& stream) {
  return entry.extension != nullptr && (stream.Entry == nullptr || extensible(*stream.Entry) != nullptr);
}

void extend(const OD_extension_t& extension, OD_IO_t& io) {
  io.stream.object = extension.object;
  io.read = extension.read == nullptr ? no_read : extension.read;
  io.write = extension.write == nullptr ? no_write : extension.write;
}

// Returns whether at least one entry of the object can be extended.
bool has_extensible(const OD_entry_t& entry) {
  if (!is_of_table(entry)) {
    return true;
  }
  const OD_t& od = owner_of(entry);
  uint32_t position = dict::first_from(od.Table, od.TableLen, CO_DEV(entry.index, 0));
  while (position < od.TableLen && CO_GET_IDX(od.Table[position].Key) == entry.index &&
         extensible(od.Table[position]) == nullptr) {
    ++position;
  }
  return position < od.TableLen && CO_GET_IDX(od.Table[position].Key) == entry.index;
}

bool changes_nothing(const OD_extension_t& extension) {
  return extension.read == OD_readOriginal && extension.write == OD_writeOriginal;
}

// Checks the result of a function that must read or write a complete value in one call. Returns if_wrong_length if the
// function has succeeded with another number of bytes than length, else the result.
ODR_t check_length(ODR_t result, OD_size_t passed, OD_size_t length, ODR_t if_wrong_length) {
  if (result == ODR_OK && passed != length) {
    return if_wrong_length;
  }
  return result;
}

}  // namespace
}  // namespace co::od

extern "C" {

ODR_t OD_getSub(const OD_entry_t* entry, uint8_t subIndex, OD_IO_t* io, bool_t odOrig) {
  if (entry == nullptr || entry->odObject == nullptr) {
    return ODR_IDX_NOT_EXIST;
  }
  if (io == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  const ODR_t result = co::od::describe(*entry, subIndex, io->stream);
  if (result != ODR_OK) {
    return result;
  }
  io->read = OD_readOriginal;
  io->write = OD_writeOriginal;
  if (!odOrig && co::od::is_extended(*entry, io->stream)) {
    co::od::extend(*entry->extension, *io);
  }
  return ODR_OK;
}

bool_t OD_mappable(const OD_stream_t* stream) {
  return stream != nullptr && (stream->attribute & (ODA_TRPDO | ODA_TRSRDO)) != 0;
}

void OD_rwRestart(OD_stream_t* stream) {
  if (stream != nullptr) {
    stream->dataOffset = 0;
  }
}

ODR_t OD_extension_init(OD_entry_t* entry, OD_extension_t* extension) {
  if (entry == nullptr) {
    return ODR_IDX_NOT_EXIST;
  }
  if (extension != nullptr && !co::od::changes_nothing(*extension) && !co::od::has_extensible(*entry)) {
    return ODR_UNSUPP_ACCESS;
  }
  const bool is_other = entry->extension != extension;
  entry->extension = extension;
  if (is_other && co::od::is_of_table(*entry)) {
    co::od::end_accesses(co::od::owner_of(*entry), entry->index);
  }
  return ODR_OK;
}

ODR_t OD_get_value(const OD_entry_t* entry, uint8_t subIndex, void* val, OD_size_t len, bool_t odOrig) {
  if (val == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  OD_IO_t io;
  const ODR_t found = OD_getSub(entry, subIndex, &io, odOrig);
  if (found != ODR_OK) {
    return found;
  }
  if (io.stream.dataLength != len) {
    return ODR_TYPE_MISMATCH;
  }
  OD_size_t passed = len;
  const ODR_t result = io.read(&io.stream, val, len, &passed);
  return co::od::check_length(result, passed, len, ODR_DATA_SHORT);
}

ODR_t OD_set_value(const OD_entry_t* entry, uint8_t subIndex, void* val, OD_size_t len, bool_t odOrig) {
  if (val == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  OD_IO_t io;
  const ODR_t found = OD_getSub(entry, subIndex, &io, odOrig);
  if (found != ODR_OK) {
    return found;
  }
  if (io.stream.dataLength != len) {
    return ODR_TYPE_MISMATCH;
  }
  OD_size_t passed = len;
  const ODR_t result = io.write(&io.stream, val, len, &passed);
  return co::od::check_length(result, passed, len, ODR_DEV_INCOMPAT);
}

void* OD_getPtr(const OD_entry_t* entry, uint8_t subIndex, OD_size_t len, ODR_t* err) {
  OD_IO_t io;
  ODR_t result = OD_getSub(entry, subIndex, &io, true);
  if (result == ODR_OK && (io.stream.dataOrig == nullptr || io.stream.dataLength == 0)) {
    result = ODR_DEV_INCOMPAT;
  } else if (result == ODR_OK && len != 0 && len != io.stream.dataLength) {
    result = ODR_TYPE_MISMATCH;
  }
  if (err != nullptr) {
    *err = result;
  }
  return result == ODR_OK ? io.stream.dataOrig : nullptr;
}

}  // extern "C"

#endif
