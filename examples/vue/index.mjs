// npm i && npm start: notes to drag about, which say which of them overlap.
import { createApp } from 'vue';
import App from './App.vue';

createApp(App).mount('#app');
