// For the linker: what faqem.js gives to the module.
mergeInto(LibraryManager.library, { faqem_web_progress: () => 0 });
