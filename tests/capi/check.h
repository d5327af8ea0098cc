#pragma once
/* Helpers shared by the tests of the C interface. */

#include <stdio.h>
#include <stdlib.h>

/* Like assert(), but also active if NDEBUG is defined. */
#define CHECK(condition)                                                    \
    do {                                                                    \
        if (!(condition)) {                                                 \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            exit(1);                                                        \
        }                                                                   \
    } while (0)

#include "faqem/faqem.h"

/* Returns a flat grid of n x n squares over [0, n]^2, n <= 20. All calls share the same static arrays. */
faqem_mesh flat_grid(uint32_t n);
faqem_mesh flat_grid_of_doubles(uint32_t n);

void test_simplify(void);
void test_layout(void);
void test_options(void);
void test_levels(void);
void test_asset(void);
void test_asset_levels(void);
void test_asset_textures(void);
