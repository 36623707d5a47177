/* Snapshots of a whole instance: FMU states, and their form as bytes.
 *
 * bytes: header | instance fields | inputs | outputs | parameters | network, if there is one | model state
 * The bytes hold no pointers; both FMI versions of a product share them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "network.h"

enum { SNAPSHOT_VERSION = 1, BYTE_ORDER_MARK = 0x01020304, MAX_BODY = 1 << 30 };
static const char MAGIC[8] = {'H', 'O', 'A', 'P', '2', 'F', 'M', 'U'};

typedef struct {
  char magic[8];
  int32_t version;
  int32_t byte_order;
  char product[32];
  char token[40]; /* hash of the tables: another table is another layout */
  int32_t schema;
  int32_t reserved; /* 0 */
  uint64_t body_size;
  uint64_t checksum; /* of the body */
} header_t;

typedef struct {
  int32_t mode;
  int32_t model_ready;
  int64_t tick;
  double start_time_s;
  double stop_time_s;
} fields_t;

typedef struct {
  header_t header;
  fields_t fields;
  /* the rest follows */
} snapshot_t;

/* FNV-1a: finds damage, is no protection against forgery. */
static uint64_t checksum_of(const unsigned char *bytes, size_t size) {
  uint64_t hash = 14695981039346656037u;
  for (size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

/* Of a snapshot without its model state. */
static size_t frame_size(void) {
  size_t size = sizeof(snapshot_t);
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) size += HOAP2_FMU_PRODUCT.group_size[g];
  return size + hoap2_network_size();
}

static size_t snapshot_size(const header_t *header) { return sizeof(header_t) + (size_t)header->body_size; }

static uint64_t body_checksum(const void *snapshot, size_t size) {
  return checksum_of((const unsigned char *)snapshot + sizeof(header_t), size - sizeof(header_t));
}

static header_t make_header(size_t size) {
  header_t header;
  memset(&header, 0, sizeof header);
  memcpy(header.magic, MAGIC, sizeof MAGIC);
  header.version = SNAPSHOT_VERSION;
  header.byte_order = BYTE_ORDER_MARK;
  strncpy(header.product, hoap2_network_name(), sizeof header.product - 1);
  strncpy(header.token, hoap2_network_token(), sizeof header.token - 1);
  header.schema = HOAP2_FMU_PRODUCT.schema;
  header.body_size = size - sizeof(header_t);
  return header;
}

/* NULL, or what is wrong with a header. */
static const char *header_fault(const header_t *found) {
  const header_t expected = make_header(frame_size());
  if (memcmp(found->magic, expected.magic, sizeof expected.magic) != 0) return "it is not a HOAP-2 state";
  if (found->version != expected.version || found->reserved != 0) return "its format has another version";
  if (found->byte_order != expected.byte_order) return "its byte order is another machine's";
  if (memcmp(found->product, expected.product, sizeof expected.product) != 0)
    return "it belongs to another product";
  if (found->schema != expected.schema || memcmp(found->token, expected.token, sizeof expected.token) != 0) {
    return "it was made with another table of signals";
  }
  if (found->body_size < expected.body_size || found->body_size > MAX_BODY) return "its size is wrong";
  return NULL;
}

hoap2_fmu_status_t hoap2_fmu_get_state(hoap2_fmu_instance_t *self, void **state) {
  if (!state) return hoap2_fmu_error(self, "get state: NULL pointer");
  if (*state && header_fault(*state))
    return hoap2_fmu_error(self, "get state: the given state is not one of this FMU");
  const size_t size = frame_size() + hoap2_product_state_size(self->model);
  if (*state && snapshot_size(*state) != size) hoap2_fmu_free_state(self, state);
  if (!*state) *state = calloc(1, size);
  if (!*state) return hoap2_fmu_error(self, "get state: out of memory");
  snapshot_t *snapshot = *state;
  snapshot->header = make_header(size);
  snapshot->fields.mode = (int32_t)self->mode;
  snapshot->fields.model_ready = self->model_ready;
  snapshot->fields.tick = self->tick;
  snapshot->fields.start_time_s = self->start_time_s;
  snapshot->fields.stop_time_s = self->stop_time_s;
  char *rest = (char *)(snapshot + 1);
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) {
    memcpy(rest, self->group[g], HOAP2_FMU_PRODUCT.group_size[g]);
    rest += HOAP2_FMU_PRODUCT.group_size[g];
  }
  if (self->network) memcpy(rest, self->network, hoap2_network_size());
  rest += hoap2_network_size();
  if (self->model_ready) {
    hoap2_product_get_state(self->model, rest);
  } else {
    memset(rest, 0, size - frame_size());
  }
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_set_state(hoap2_fmu_instance_t *self, const void *state) {
  if (!state) return hoap2_fmu_error(self, "set state: NULL pointer");
  const snapshot_t *snapshot = state;
  const char *fault = header_fault(&snapshot->header);
  if (fault) return hoap2_fmu_error(self, "set state: %s", fault);
  const char *groups = (const char *)(snapshot + 1);
  const char *model = groups;
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) model += HOAP2_FMU_PRODUCT.group_size[g];
  const unsigned initialised = (unsigned)snapshot->fields.mode & (HOAP2_FMU_RUNNING | HOAP2_FMU_TERMINATED);
  fault = hoap2_network_fault(self, model, initialised != 0);
  if (fault) return hoap2_fmu_error(self, "set state: %s", fault);
  const char *network = model;
  model += hoap2_network_size();
  const size_t model_size = snapshot_size(&snapshot->header) - frame_size();
  if (snapshot->fields.model_ready && hoap2_product_set_state(self->model, model, model_size) != 0) {
    return hoap2_fmu_error(self, "set state: %s", hoap2_product_error(self->model));
  }
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) {
    memcpy(self->group[g], groups, HOAP2_FMU_PRODUCT.group_size[g]);
    groups += HOAP2_FMU_PRODUCT.group_size[g];
  }
  if (self->network) memcpy(self->network, network, hoap2_network_size());
  self->mode = (hoap2_fmu_mode_t)snapshot->fields.mode;
  self->model_ready = snapshot->fields.model_ready != 0;
  self->tick = snapshot->fields.tick;
  self->start_time_s = snapshot->fields.start_time_s;
  self->stop_time_s = snapshot->fields.stop_time_s;
  hoap2_fmu_log(self, HOAP2_FMU_LOG_EVENT, "state of %.9g s restored", hoap2_fmu_time_s(self));
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_free_state(hoap2_fmu_instance_t *self, void **state) {
  if (!state || !*state) return HOAP2_FMU_OK; /* like free(NULL) */
  snapshot_t *snapshot = *state;
  const char *fault = header_fault(&snapshot->header);
  if (fault) return hoap2_fmu_error(self, "free state: %s", fault);
  memset(&snapshot->header, 0, sizeof snapshot->header);
  free(snapshot);
  *state = NULL;
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_serialized_size(hoap2_fmu_instance_t *self, const void *state, size_t *size) {
  if (!state || !size) return hoap2_fmu_error(self, "serialized size: NULL pointer");
  const char *fault = header_fault(state);
  if (fault) return hoap2_fmu_error(self, "serialized size: %s", fault);
  *size = snapshot_size(state);
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_serialize(hoap2_fmu_instance_t *self, const void *state, void *bytes,
                                       size_t size) {
  if (!state || !bytes) return hoap2_fmu_error(self, "serialize: NULL pointer");
  const char *fault = header_fault(state);
  if (fault) return hoap2_fmu_error(self, "serialize: %s", fault);
  const size_t needed = snapshot_size(state);
  if (size < needed) return hoap2_fmu_error(self, "serialize: %zu bytes given, %zu needed", size, needed);
  header_t header = make_header(needed);
  header.checksum = body_checksum(state, needed);
  memcpy(bytes, state, needed);
  memcpy(bytes, &header, sizeof header);
  return HOAP2_FMU_OK;
}

/* Values that no instance of ours writes. */
static bool fields_plausible(const fields_t *fields) {
  const bool mode_ok = fields->mode == HOAP2_FMU_INSTANTIATED || fields->mode == HOAP2_FMU_INITIALISING ||
                       fields->mode == HOAP2_FMU_STEPPING || fields->mode == HOAP2_FMU_TERMINATED ||
                       (fields->mode == HOAP2_FMU_EVENT && hoap2_network_present());
  const bool ready_ok =
      fields->model_ready == 1 || (fields->model_ready == 0 && !((unsigned)fields->mode & HOAP2_FMU_RUNNING));
  return mode_ok && ready_ok && fields->tick >= 0 && isfinite(fields->start_time_s) &&
         !isnan(fields->stop_time_s);
}

hoap2_fmu_status_t hoap2_fmu_deserialize(hoap2_fmu_instance_t *self, const void *bytes, size_t size,
                                         void **state) {
  if (!state || !bytes) return hoap2_fmu_error(self, "deserialize: NULL pointer");
  if (size < sizeof(header_t))
    return hoap2_fmu_error(self, "deserialize: %zu bytes are too few for a state", size);
  header_t header;
  memcpy(&header, bytes, sizeof header);
  const char *fault = header_fault(&header);
  if (fault) return hoap2_fmu_error(self, "deserialize: %s", fault);
  if (size != snapshot_size(&header)) {
    return hoap2_fmu_error(self, "deserialize: %zu bytes given, this state has %zu", size,
                           snapshot_size(&header));
  }
  if (header.checksum != body_checksum(bytes, size)) {
    return hoap2_fmu_error(self, "deserialize: the bytes are damaged (checksum)");
  }
  fields_t fields;
  memcpy(&fields, (const char *)bytes + sizeof header, sizeof fields);
  if (!fields_plausible(&fields)) return hoap2_fmu_error(self, "deserialize: impossible values");
  const bool reuse = *state && !header_fault(*state) && snapshot_size(*state) == size;
  void *copy = reuse ? *state : malloc(size);
  if (!copy) return hoap2_fmu_error(self, "deserialize: out of memory");
  memcpy(copy, bytes, size);
  *state = copy;
  return HOAP2_FMU_OK;
}
