// The source of the object that owns the tests' precompiled headers.
