/* Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_LS_BUS_TOKENS_H
#define HOAP2_LS_BUS_TOKENS_H
#define HOAP2_LS_CONTROLLER_TOKEN "{8b694d01-2085-08ae-39f6-ab95f9524277}"
#define HOAP2_LS_PLANT_TOKEN "{106c3331-68b5-6368-af25-2cbaca2f9314}"
#define HOAP2_LS_BUS_TOKEN "{c7b6eda1-1c5e-e2b5-f2bc-bdc62db9660f}"
#endif
