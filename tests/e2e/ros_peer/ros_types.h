#pragma once

#include <dds/dds.h>
#include <stddef.h>
#include <stdint.h>

struct type {
  const char* name;
  const dds_topic_descriptor_t* descriptor;
  void (*print)(const void* sample); /* null: not read */
};

/* Ends the program if there is none. */
const struct type* find_type(const char* name);

/* "0123ef" */
void print_hex(const uint8_t* bytes, size_t count);
